#include "runtime/texture/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <vector>

#include "runtime/texture/exr_header.h"
#include "runtime/texture/image_format.h"
#include "runtime/texture/png_chunks.h"

namespace nacre {

namespace {

constexpr int max_subimages = 1024;
constexpr int rows_at_once = 64;  // For files in scanlines.

SampleType sample_type(OIIO::TypeDesc type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8: return SampleType::unsigned8;
    case OIIO::TypeDesc::UINT16: return SampleType::unsigned16;
    case OIIO::TypeDesc::HALF: return SampleType::half;
    default: return SampleType::floating;
  }
}

std::string subimage_name(const OIIO::ImageSpec& spec) {
  const std::string name(spec.get_string_attribute("oiio:subimagename"));
  return name.empty() ? std::string(spec.get_string_attribute("name")) : name;
}

/// "diffuse.R" -> "diffuse"; "R" -> "".
std::string layer_of(const std::string& channel) {
  const auto dot = channel.rfind('.');
  return dot == std::string::npos ? std::string() : channel.substr(0, dot);
}

/// The run of at most four channels of one layer that starts at `first`.
int run_length(const OIIO::ImageSpec& spec, int first) {
  const auto name = [&](int c) {
    const auto at = static_cast<std::size_t>(c);
    return at < spec.channelnames.size() ? spec.channelnames[at] : std::string();
  };
  int count = 1;
  while (count < 4 && first + count < spec.nchannels && first + count != spec.z_channel &&
         layer_of(name(first + count)) == layer_of(name(first))) {
    ++count;
  }
  return count;
}

/// Moves `input` to the image a layer name means; true if there is one.
bool select_layer(OIIO::ImageInput& input, const std::string& layer, ImageInfo& info) {
  for (int i = 0; i < max_subimages && input.seek_subimage(i, 0); ++i) {
    if (layer.empty() || subimage_name(input.spec()) == layer) {
      info.subimage = i;
      return true;
    }
  }
  for (int i = 0; i < max_subimages && input.seek_subimage(i, 0); ++i) {
    const auto& names = input.spec().channelnames;
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& n) { return layer_of(n) == layer; });
    if (found != names.end()) {
      info.subimage = i;
      info.first_channel = static_cast<int>(found - names.begin());
      return true;
    }
  }
  int number = -1;
  const char* end = layer.data() + layer.size();
  const auto parsed = std::from_chars(layer.data(), end, number);
  if (parsed.ec != std::errc() || parsed.ptr != end || number < 0) return false;
  if (number >= max_subimages || !input.seek_subimage(number, 0)) return false;
  info.subimage = number;
  return true;
}

bool within(int value, int limit) { return value >= 1 && value <= limit; }

/// The header's sizes against the limits, before anything is allocated from them.
std::optional<Diagnostic> check_header(const OIIO::ImageSpec& spec, const std::string& path,
                                       const ImageInfo& info, const ImageLimits& limits,
                                       std::uint64_t file_bytes) {
  if (!within(spec.width, limits.max_size) || !within(spec.height, limits.max_size) ||
      !within(spec.full_width, limits.max_size) || !within(spec.full_height, limits.max_size)) {
    return image_error("image-too-large", path, "the size of the image is outside the limits",
                       fmt::format("1 to {} on either side", limits.max_size),
                       fmt::format("{} x {}", spec.width, spec.height));
  }
  if (spec.depth > 1 || spec.deep || spec.nchannels < 1) {
    return image_error("unsupported-image", path, "the image is not a flat two-dimensional one");
  }
  // Rows of tiles are decoded together, as floats.
  const std::uint64_t tile_row =
      static_cast<std::uint64_t>(std::clamp(spec.tile_height, 1, spec.height)) *
      static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(info.channels) *
      sizeof(float);
  if (spec.tile_width != 0 &&
      (!within(spec.tile_width, limits.max_size) || !within(spec.tile_height, limits.max_size) ||
       tile_row > limits.max_bytes)) {
    return image_error("image-too-large", path, "the tiles of the image are outside the limits",
                       fmt::format("1 to {} on either side", limits.max_size),
                       fmt::format("{} x {}", spec.tile_width, spec.tile_height));
  }
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  const std::uint64_t bytes =
      pixels * static_cast<std::uint64_t>(info.channels) * spec.format.basesize();
  if (bytes > limits.max_bytes) {
    return image_error("image-too-large", path, "the image is too large",
                       fmt::format("at most {} bytes of pixels", limits.max_bytes),
                       fmt::format("{}", bytes));
  }
  if (bytes / limits.max_expansion > file_bytes) {
    return image_error("broken-image", path, "the header promises more than the file can hold",
                       fmt::format("at most {} bytes of pixels", file_bytes * limits.max_expansion),
                       fmt::format("{}", bytes));
  }
  return std::nullopt;
}

/// OpenImageIO's reason on one line; it may end in stops and new lines.
Diagnostic broken(const std::string& path, std::string reason) {
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  while (!reason.empty() && (reason.back() == ' ' || reason.back() == '.')) reason.pop_back();
  return image_error("broken-image", path, "the image cannot be read", {},
                     reason.empty() ? "no reason given by the reader" : reason);
}

/// The reader allocates a GIF's canvas before it says how large it is (GIF89a, 18).
std::optional<Diagnostic> check_gif(const std::string& path, const ImageLimits& limits) {
  std::ifstream stream(path, std::ios::binary);
  std::array<unsigned char, 10> head{};
  stream.read(reinterpret_cast<char*>(head.data()), head.size());
  const int width = head[6] | head[7] << 8;
  const int height = head[8] | head[9] << 8;
  const std::uint64_t bytes =
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * 4;
  if (within(width, limits.max_size) && within(height, limits.max_size) &&
      bytes <= limits.max_bytes) {
    return std::nullopt;
  }
  return image_error("image-too-large", path, "the size of the image is outside the limits",
                     fmt::format("1 to {} on either side", limits.max_size),
                     fmt::format("{} x {}", width, height));
}

OIIO::ImageSpec reader_options() {
  OIIO::ImageSpec options;
  options["oiio:UnassociatedAlpha"] = 1;
  return options;
}

}  // namespace

struct ImageReader::Open {
  std::string bytes;  ///< Of a PNG file; others are read in place.
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
};

std::optional<Diagnostic> ImageReader::take_png(Open& opened, std::uint64_t file_bytes) const {
  std::ifstream stream(path_, std::ios::binary);
  std::string file(static_cast<std::size_t>(file_bytes), '\0');
  stream.read(file.data(), static_cast<std::streamsize>(file.size()));
  file.resize(static_cast<std::size_t>(stream.gcount()));
  std::string reason;
  auto essential = essential_png(file, reason);
  if (!essential) return broken(path_, reason);
  opened.bytes = std::move(*essential);
  opened.memory =
      std::make_unique<OIIO::Filesystem::IOMemReader>(opened.bytes.data(), opened.bytes.size());
  opened.input->set_ioproxy(opened.memory.get());
  return std::nullopt;
}

ImageReader::ImageReader() = default;
ImageReader::~ImageReader() = default;

std::optional<Diagnostic> ImageReader::open(const std::string& path, const std::string& layer,
                                            const ImageLimits& limits) {
  path_ = path;
  info_ = {};
  Diagnostic error;
  const auto format = probe_image(path, error);
  if (!format) return error;
  std::error_code code;
  const std::uint64_t file_bytes = std::filesystem::file_size(path, code);
  if (code || file_bytes > limits.max_file_bytes) {
    return image_error("image-too-large", path, "the file is too large",
                       fmt::format("at most {} bytes", limits.max_file_bytes),
                       fmt::format("{}", file_bytes));
  }

  auto opened = std::make_unique<Open>();
  opened->input = OIIO::ImageInput::create(std::string(reader_name(*format)));
  if (!opened->input) return broken(path, OIIO::geterror());
  if (*format == ImageFormat::png) {
    if (auto problem = take_png(*opened, file_bytes)) return problem;
  }
  if (*format == ImageFormat::exr) {
    std::ifstream stream(path, std::ios::binary);
    if (auto reason = exr_header_fault(stream, file_bytes, limits)) return broken(path, *reason);
  }
  if (*format == ImageFormat::gif) {
    if (auto problem = check_gif(path, limits)) return problem;
  }
  OIIO::ImageInput& input = *opened->input;
  if (!input.open(path, opened->spec, reader_options())) return broken(path, input.geterror());
  if (!select_layer(input, layer, info_)) {
    if (layer.empty()) return broken(path, input.geterror());
    return image_error("unknown-image-layer", path, "the image has no such layer",
                       "the name of a subimage, of a group of channels, or a page number", layer);
  }
  // A search may end on another subimage than the one it found.
  if (!input.seek_subimage(info_.subimage, 0)) return broken(path, input.geterror());
  opened->spec = input.spec();
  const OIIO::ImageSpec& spec = opened->spec;
  info_.width = spec.full_width;
  info_.height = spec.full_height;
  info_.channels = spec.nchannels > 0 ? run_length(spec, info_.first_channel) : 0;
  info_.samples = sample_type(spec.format);
  if (auto problem = check_header(spec, path, info_, limits, file_bytes)) return problem;
  open_ = std::move(opened);
  return std::nullopt;
}

std::optional<Diagnostic> ImageReader::read(const std::function<void(int, const float*)>& row) {
  const OIIO::ImageSpec& spec = open_->spec;
  OIIO::ImageInput& input = *open_->input;
  const int first = info_.first_channel;
  const int last = first + info_.channels;
  const auto channels = static_cast<std::size_t>(info_.channels);
  const int step = spec.tile_width > 0 ? spec.tile_height : rows_at_once;
  const std::size_t data_row = static_cast<std::size_t>(spec.width) * channels;
  std::vector<float> chunk(static_cast<std::size_t>(std::min(step, spec.height)) * data_row);
  std::vector<float> full(static_cast<std::size_t>(info_.width) * channels);

  // Columns of the data window that the full window shows.
  const int x_begin = std::max(spec.x, spec.full_x);
  const int x_end = std::min(spec.x + spec.width, spec.full_x + spec.full_width);
  const int y_begin = spec.full_y;
  const int y_end = spec.full_y + spec.full_height;
  int next = y_begin;
  const auto blank_until = [&](int y) {
    std::fill(full.begin(), full.end(), 0.f);
    for (; next < std::min(y, y_end); ++next) row(next - y_begin, full.data());
  };

  for (int y = spec.y; y < spec.y + spec.height && y < y_end; y += step) {
    const int end = std::min(y + step, spec.y + spec.height);
    const bool good =
        spec.tile_width > 0
            ? input.read_tiles(info_.subimage, 0, spec.x, spec.x + spec.width, y, end, spec.z,
                               spec.z + 1, first, last, OIIO::TypeFloat, chunk.data())
            : input.read_scanlines(info_.subimage, 0, y, end, spec.z, first, last, OIIO::TypeFloat,
                                   chunk.data());
    // The TIFF reader says yes, and leaves an error behind, when a strip is cut short.
    if (!good || input.has_error()) return broken(path_, input.geterror());
    blank_until(y);
    for (int line = std::max(y, y_begin); line < std::min(end, y_end); ++line, ++next) {
      const float* samples = &chunk[static_cast<std::size_t>(line - y) * data_row];
      std::fill(full.begin(), full.end(), 0.f);
      if (x_begin < x_end) {
        std::copy(samples + static_cast<std::size_t>(x_begin - spec.x) * channels,
                  samples + static_cast<std::size_t>(x_end - spec.x) * channels,
                  full.begin() + static_cast<std::ptrdiff_t>(
                                     static_cast<std::size_t>(x_begin - spec.full_x) * channels));
      }
      row(line - y_begin, full.data());
    }
  }
  blank_until(y_end);
  return std::nullopt;
}

struct TileCache::Cache {
  OIIO::ImageCache* cache = nullptr;
  ~Cache() {
    if (cache) OIIO::ImageCache::destroy(cache);
  }
};

struct TileCache::File {
  struct Level {
    int width = 0;
    int height = 0;
    int x = 0;  ///< Origin of the full window.
    int y = 0;
  };
  OIIO::ImageCache::ImageHandle* handle = nullptr;
  ImageInfo info;
  std::vector<Level> levels;
};

TileCache::TileCache(std::uint64_t budget_bytes) : cache_(std::make_unique<Cache>()) {
  cache_->cache = OIIO::ImageCache::create(/*shared=*/false);
  OIIO::ImageCache& cache = *cache_->cache;
  cache.attribute("max_memory_MB", static_cast<float>(budget_bytes) / (1024.f * 1024.f));
  cache.attribute("autotile", 64);
  cache.attribute("automip", 1);
  cache.attribute("unassociatedalpha", 1);
}

TileCache::~TileCache() = default;

std::shared_ptr<TileCache::File> TileCache::open(const std::string& path, const ImageInfo& info) {
  OIIO::ImageCache& cache = *cache_->cache;
  auto file = std::make_shared<File>();
  file->info = info;
  file->handle = cache.get_image_handle(OIIO::ustring(path));
  if (!file->handle || !cache.good(file->handle)) {
    cache.geterror();
    return nullptr;
  }
  OIIO::ImageSpec spec;
  for (int level = 0; cache.get_imagespec(file->handle, nullptr, spec, info.subimage, level);
       ++level) {
    file->levels.push_back({spec.full_width, spec.full_height, spec.full_x, spec.full_y});
    if (spec.full_width <= 1 && spec.full_height <= 1) break;
  }
  cache.geterror();  // Asking past the last level is how we learn their number.
  return file->levels.empty() ? nullptr : file;
}

int TileCache::level_count(const File& file) { return static_cast<int>(file.levels.size()); }

int TileCache::width(const File& file, int level) {
  return file.levels[static_cast<std::size_t>(level)].width;
}

int TileCache::height(const File& file, int level) {
  return file.levels[static_cast<std::size_t>(level)].height;
}

bool TileCache::read(const File& file, int level, int x0, int x1, int y0, int y1,
                     float* samples) const {
  OIIO::ImageCache& cache = *cache_->cache;
  const File::Level& size = file.levels[static_cast<std::size_t>(level)];
  const int first = file.info.first_channel;
  const bool good = cache.get_pixels(file.handle, nullptr, file.info.subimage, level, size.x + x0,
                                     size.x + x1, size.y + y0, size.y + y1, 0, 1, first,
                                     first + file.info.channels, OIIO::TypeFloat, samples);
  if (!good) cache.geterror();
  return good;
}

}  // namespace nacre
