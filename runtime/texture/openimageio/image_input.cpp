#include "runtime/texture/openimageio/image_input.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <utility>

#include "runtime/texture/essential_image.h"
#include "runtime/texture/exr_header.h"
#include "runtime/texture/tiff_directories.h"

namespace nacre {

namespace {

/// A file for OpenImageIO that has nothing more to give once a stop is due, and in which
/// some pairs of bytes read differently.
class GuardedSource final : public OIIO::Filesystem::IOFile {
 public:
  GuardedSource(std::FILE* file, const Stop& stop, TiffDirectories directories)
      : IOFile(file, Read), stream_(file), stop_(stop), directories_(std::move(directories)) {}
  ~GuardedSource() override { std::fclose(stream_); }

  std::size_t read(void* to, std::size_t count) override {
    if (stop_.is_due()) return 0;
    const std::int64_t from = tell();
    return hide(to, IOFile::read(to, count), from);
  }
  std::size_t pread(void* to, std::size_t count, std::int64_t from) override {
    if (stop_.is_due()) return 0;
    return hide(to, IOFile::pread(to, count, from), from);
  }

 private:
  std::size_t hide(void* to, std::size_t count, std::int64_t from) const {
    const auto first = static_cast<std::uint64_t>(from);
    for (const std::uint64_t entry : directories_.hidden) {
      for (std::uint64_t i = 0; i < 2; ++i) {
        if (entry + i < first || entry + i >= first + count) continue;
        const unsigned shift = (directories_.is_big_endian ? 1 - i : i) != 0 ? 8 : 0;
        static_cast<unsigned char*>(to)[entry + i - first] =
            static_cast<unsigned char>(hidden_tiff_entry >> shift);
      }
    }
    return count;
  }

  std::FILE* stream_;
  Stop stop_;
  TiffDirectories directories_;
};

using Essence = std::optional<Diagnostic> (*)(const ImageFile&, const ImageLimits&, ImageExtent,
                                              std::string&);

/// For formats of which a reader gets a copy without what the pixels do not need.
Essence essence_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::png: return essential_png;
    case ImageFormat::jpeg: return essential_jpeg;
    case ImageFormat::tga: return essential_tga;
    case ImageFormat::bmp: return essential_bmp;
    case ImageFormat::gif: return essential_gif;
    default: return nullptr;
  }
}

/// Of TIFF, whose list of ways to pack is open: none, LZW, JPEG, Deflate twice, PackBits,
/// LZMA and Zstandard. Others are old, broken, or for faxes.
constexpr std::array tiff_packings{1, 5, 7, 8, 32946, 32773, 34925, 50000};

bool within(int value, int limit) { return value >= 1 && value <= limit; }

std::uint64_t area(int width, int height) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

Diagnostic too_large(const ImageFile& file, std::string message, std::string expected,
                     std::string found) {
  return image_error("image-too-large", file.path(), std::move(message), std::move(expected),
                     std::move(found));
}

std::optional<Diagnostic> check_tiles(const OIIO::ImageSpec& spec, const ImageFile& file,
                                      const ImageLimits& limits) {
  if (spec.tile_width == 0) return std::nullopt;
  // Rows of tiles are decoded together, all channels of them.
  const std::uint64_t row = area(spec.width, std::clamp(spec.tile_height, 1, spec.height)) *
                            static_cast<std::uint64_t>(spec.nchannels) * sizeof(float);
  if (within(spec.tile_width, limits.max_size) && within(spec.tile_height, limits.max_size) &&
      row <= 2 * limits.max_bytes) {
    return std::nullopt;
  }
  return too_large(file, "the tiles of the image are outside the limits",
                   fmt::format("1 to {} on either side", limits.max_size),
                   fmt::format("{} x {}", spec.tile_width, spec.tile_height));
}

std::optional<Diagnostic> check_bytes(const OIIO::ImageSpec& spec, const ImageFile& file,
                                      int channels, const ImageLimits& limits) {
  const std::uint64_t sample = spec.format.basesize();
  // Only of an EXR are channels read that nobody asks for, one run of lines at a time.
  const bool reads_all = file.format() != ImageFormat::exr;
  const auto kept = static_cast<std::uint64_t>(channels);
  const auto decoded = reads_all ? static_cast<std::uint64_t>(spec.nchannels) : kept;
  const std::uint64_t pixels = area(spec.width, spec.height);
  const std::uint64_t shown = std::max(pixels, area(spec.full_width, spec.full_height));
  return check_image_bytes(file,
                           {.decoded = std::max(pixels * decoded, shown * kept) * sample,
                            .kept = pixels * kept * sample,
                            .in_memory = shown * 4 * (kept == 1 ? 1 : sample)},
                           limits);
}

}  // namespace

bool GuardedInput::seek(int subimage, int level) {
  const bool has_one = essence_of(file->format()) != nullptr;
  if (has_one && (subimage != 0 || level != 0)) return false;
  return reader->seek_subimage(subimage, level);
}

std::optional<Diagnostic> open_input(std::shared_ptr<const ImageFile> file,
                                     const ImageLimits& limits, ImageExtent extent,
                                     const Stop& stop, GuardedInput& input) {
  input.close();
  input.file = std::move(file);
  const ImageFile& from = *input.file;
  const auto broken = [&](std::string reason) {
    return broken_image(from.path(), std::move(reason));
  };
  TiffDirectories directories;
  if (from.format() == ImageFormat::exr) {
    if (auto problem = check_exr_header(from, limits)) return problem;
  } else if (from.format() == ImageFormat::tiff) {
    if (auto reason = tiff_fault(from, limits, directories)) return broken(*reason);
  }
  if (const Essence essence = essence_of(from.format())) {
    if (auto problem = essence(from, limits, extent, input.bytes)) return problem;
    input.source =
        std::make_unique<OIIO::Filesystem::IOMemReader>(input.bytes.data(), input.bytes.size());
  } else {
    const int descriptor = ::dup(from.descriptor());
    std::FILE* stream = descriptor < 0 ? nullptr : ::fdopen(descriptor, "rb");
    if (stream == nullptr) {
      if (descriptor >= 0) ::close(descriptor);
      return broken("the file cannot be opened once more");
    }
    input.source = std::make_unique<GuardedSource>(stream, stop, std::move(directories));
  }
  input.reader = OIIO::ImageInput::create(std::string(reader_name(from.format())));
  if (!input.reader) return broken(OIIO::geterror());
  OIIO::ImageSpec options, ignored;
  options["oiio:UnassociatedAlpha"] = 1;
  // Readers that go back to an earlier row open again what these say, and without it the
  // file itself, past all that was looked at. With a slash behind it, it cannot be opened.
  OIIO::Filesystem::IOProxy* source = input.source.get();
  options.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &source);
  if (!input.reader->open(from.path() + '/', ignored, options)) {
    return broken(input.reader->geterror());
  }
  return std::nullopt;
}

std::optional<Diagnostic> check_header(const OIIO::ImageSpec& spec, const ImageFile& file,
                                       int channels, const ImageLimits& limits) {
  for (const auto& [width, height] :
       {std::pair{spec.width, spec.height}, {spec.full_width, spec.full_height}}) {
    if (auto problem = check_image_size(file.path(), width, height, limits)) return problem;
  }
  if (spec.depth > 1 || spec.full_depth > 1 || spec.tile_depth > 1 || spec.deep ||
      spec.nchannels < 1) {
    return image_error("unsupported-image", file.path(),
                       "the image is not a flat two-dimensional one");
  }
  if (spec.nchannels > limits.max_channels) {
    return too_large(file, "the image has too many channels",
                     fmt::format("at most {}", limits.max_channels),
                     fmt::format("{}", spec.nchannels));
  }
  const int packing = spec.get_int_attribute("tiff:Compression", 1);
  if (file.format() == ImageFormat::tiff &&
      std::find(tiff_packings.begin(), tiff_packings.end(), packing) == tiff_packings.end()) {
    return image_error(
        "unsupported-image", file.path(), "the pixels are packed in a way that is not read",
        "none, LZW, Deflate, PackBits, JPEG, LZMA or Zstandard", fmt::format("method {}", packing));
  }
  if (auto problem = check_tiles(spec, file, limits)) return problem;
  return check_bytes(spec, file, channels, limits);
}

}  // namespace nacre
