#include "runtime/texture/pixels.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "runtime/program/fold.h"
#include "runtime/texture/image_format.h"

namespace nacre {

namespace {

std::size_t sample_bytes(SampleType type) {
  switch (type) {
    case SampleType::unsigned8: return 1;
    case SampleType::unsigned16:
    case SampleType::half: return 2;
    case SampleType::floating: break;
  }
  return 4;
}

/// Whatever the alignment.
template <class T>
T sample_at(const std::byte* samples, std::size_t index) {
  T value;
  std::memcpy(&value, samples + index * sizeof(T), sizeof(T));
  return value;
}

float sample(SampleType type, const std::byte* samples, std::size_t index) {
  switch (type) {
    case SampleType::unsigned8:
      return static_cast<float>(sample_at<std::uint8_t>(samples, index)) / 255.0f;
    case SampleType::unsigned16:
      return static_cast<float>(sample_at<std::uint16_t>(samples, index)) / 65535.0f;
    case SampleType::half: return half_to_float(sample_at<std::uint16_t>(samples, index));
    case SampleType::floating: break;
  }
  return sample_at<float>(samples, index);
}

}  // namespace

ImageInfo info_of(const Pixels& pixels) {
  ImageInfo info;
  info.width = pixels.width;
  info.height = pixels.height;
  info.channels = pixels.channels;
  info.samples = pixels.samples;
  return info;
}

std::optional<Diagnostic> fault_of(const Pixels& pixels, const std::string& name,
                                   const ImageLimits& limits) {
  if (pixels.data == nullptr || pixels.width < 1 || pixels.height < 1 || pixels.channels < 1 ||
      pixels.channels > 4) {
    return image_error(
        "bad-image", name, "the image has no pixels", "sizes of at least 1 and 1 to 4 channels",
        fmt::format("{} x {}, {} channels", pixels.width, pixels.height, pixels.channels));
  }
  if (pixels.width > limits.max_size || pixels.height > limits.max_size) {
    return image_error("image-too-large", name, "the image is too large",
                       fmt::format("at most {} pixels either way", limits.max_size),
                       fmt::format("{} x {}", pixels.width, pixels.height));
  }
  return {};
}

void read_row(const Pixels& pixels, int y, float* samples) {
  const auto count =
      static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.channels);
  const std::ptrdiff_t row_bytes =
      pixels.row_bytes != 0 ? pixels.row_bytes
                            : static_cast<std::ptrdiff_t>(count * sample_bytes(pixels.samples));
  const auto* row = static_cast<const std::byte*>(pixels.data) + y * row_bytes;
  for (std::size_t i = 0; i < count; ++i) samples[i] = sample(pixels.samples, row, i);
}

}  // namespace nacre
