#include "runtime/texture/openimageio/image_decoder.h"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "runtime/near_names.h"
#include "runtime/texture/openimageio/image_input.h"

namespace nacre {

namespace {

constexpr int rows_at_once = 64;  // For files in scanlines.
constexpr std::uint64_t bytes_at_once = std::uint64_t{64} << 20;

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

/// The subimage, after the names of subimages and channels, that a layer name means.
bool find_layer(GuardedInput& input, const std::string& layer, int max_layers, ImageInfo& info) {
  for (int i = 0; i < max_layers && input.seek(i, 0); ++i) {
    if (layer.empty() || subimage_name(input.reader->spec()) == layer) {
      info.subimage = i;
      return true;
    }
  }
  for (int i = 0; i < max_layers && input.seek(i, 0); ++i) {
    const auto& names = input.reader->spec().channelnames;
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
  if (number >= max_layers || !input.seek(number, 0)) return false;
  info.subimage = number;
  return true;
}

/// Moves `input` to the image a layer name means; true if there is one. The search goes
/// past the last subimage, which some readers take for an error of what is read next.
bool select_layer(GuardedInput& input, const std::string& layer, int max_layers, ImageInfo& info) {
  const bool found = find_layer(input, layer, max_layers, info);
  if (!found && layer.empty()) return false;
  input.reader->geterror();
  return found && input.seek(info.subimage, 0);
}

/// The layers that there are and are called nearly so.
std::string near_layer(GuardedInput& input, const std::string& layer, int max_layers) {
  NearNames near(layer);
  for (int i = 0; i < max_layers && input.seek(i, 0); ++i) {
    near.offer(subimage_name(input.reader->spec()));
    for (const std::string& name : input.reader->spec().channelnames) near.offer(layer_of(name));
  }
  input.reader->geterror();
  return near.hint();
}

/// Rows that are decoded together: a row of tiles, or as many as is worth it.
int row_step(const OIIO::ImageSpec& spec) {
  if (spec.tile_width > 0) return spec.tile_height;
  const std::uint64_t row = static_cast<std::uint64_t>(spec.width) *
                            static_cast<std::uint64_t>(spec.nchannels) * sizeof(float);
  return static_cast<int>(
      std::clamp<std::uint64_t>(bytes_at_once / row, 1, std::uint64_t{rows_at_once}));
}

class Decoder final : public ImageDecoder {
 public:
  std::optional<Diagnostic> open(std::shared_ptr<const ImageFile> file, const std::string& layer,
                                 const ImageLimits& limits, ImageExtent extent, const Stop& stop,
                                 ImageInfo& info) override;
  std::optional<Diagnostic> read(const std::function<void(int, const float*)>& row) override;

 private:
  GuardedInput input_;
  OIIO::ImageSpec spec_;
  ImageInfo info_;
  Stop stop_;
};

std::optional<Diagnostic> Decoder::open(std::shared_ptr<const ImageFile> file,
                                        const std::string& layer, const ImageLimits& limits,
                                        ImageExtent extent, const Stop& stop, ImageInfo& info) {
  stop_ = stop;
  if (auto problem = open_input(std::move(file), limits, extent, stop_, input_)) return problem;
  OIIO::ImageInput& input = *input_.reader;
  if (!select_layer(input_, layer, limits.max_layers, info)) {
    if (layer.empty()) return broken_image(input_.file->path(), input.geterror());
    Diagnostic problem =
        image_error("unknown-image-layer", input_.file->path(), "the image has no such layer",
                    "the name of a subimage, of a group of channels, or a page number", layer);
    problem.hint = near_layer(input_, layer, limits.max_layers);
    return problem;
  }
  spec_ = input.spec();
  info.width = spec_.full_width;
  info.height = spec_.full_height;
  info.channels = spec_.nchannels > 0 ? run_length(spec_, info.first_channel) : 0;
  info.samples = sample_type(spec_.format);
  if (auto problem = check_header(spec_, *input_.file, info.channels, limits)) {
    return problem;
  }
  info_ = info;
  return std::nullopt;
}

std::optional<Diagnostic> Decoder::read(const std::function<void(int, const float*)>& row) {
  const OIIO::ImageSpec& spec = spec_;
  OIIO::ImageInput& input = *input_.reader;
  const int first = info_.first_channel;
  const int last = first + info_.channels;
  const auto channels = static_cast<std::size_t>(info_.channels);
  const int step = row_step(spec);
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
    if (!good || input.has_error() || stop_.is_due())
      return broken_image(input_.file->path(), input.geterror());
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

}  // namespace

std::unique_ptr<ImageDecoder> make_image_decoder() { return std::make_unique<Decoder>(); }

}  // namespace nacre
