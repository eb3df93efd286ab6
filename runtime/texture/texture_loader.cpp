#include "runtime/texture/texture_loader.h"

#include <vector>

#include "runtime/texture/pyramid.h"
#include "runtime/texture/texel.h"

namespace nacre {

using namespace texture_layout;

TexelFormat texel_format(const ImageInfo& info, TexelPolicy policy) {
  if (info.channels == 1) return TexelFormat::r32f;
  if (policy == TexelPolicy::full) return TexelFormat::rgba32f;
  switch (info.samples) {
    case SampleType::unsigned8: return TexelFormat::rgba8;
    case SampleType::unsigned16: return TexelFormat::rgba16;
    case SampleType::half: return TexelFormat::rgba16f;
    case SampleType::floating: break;
  }
  return policy == TexelPolicy::half ? TexelFormat::rgba16f : TexelFormat::rgba32f;
}

Plan plan_texture(const ImageInfo& info, TexelPolicy policy) {
  return plan(texel_format(info, policy), info.width, info.height, info.channels);
}

namespace {

/// Writes rows of samples as texels of level 0.
class RowEncoder {
 public:
  RowEncoder(const Plan& plan, AlignedWords& words, std::uint64_t& replaced)
      : plan_(plan),
        words_(words.span().data()),
        replaced_(replaced),
        row_(static_cast<std::size_t>(plan.width), Rgba{0.f, 0.f, 0.f, 1.f}) {
    write_header(plan, 0, words.span());
  }

  void add(int from_top, const float* samples) {
    const auto channels = static_cast<std::size_t>(plan_.channels);
    for (Rgba& texel : row_) {
      for (std::size_t c = 0; c < channels; ++c) texel[c] = sanitised(samples[c], replaced_);
      samples += channels;
    }
    encode_row(plan_, 0, plan_.height - 1 - from_top, row_, words_);
  }

 private:
  const Plan& plan_;
  std::uint32_t* words_;
  std::uint64_t& replaced_;
  std::vector<Rgba> row_;  ///< Channels that there are not keep what they have.
};

}  // namespace

std::optional<Diagnostic> load_texture(ImageReader& reader, const Plan& plan, AlignedWords& words,
                                       std::uint64_t& replaced) {
  RowEncoder encoder(plan, words, replaced);
  auto problem =
      reader.read([&](int from_top, const float* samples) { encoder.add(from_top, samples); });
  if (!problem) build_pyramid(plan, words.span());
  return problem;
}

void load_texture(const Pixels& pixels, const Plan& plan, AlignedWords& words,
                  std::uint64_t& replaced) {
  RowEncoder encoder(plan, words, replaced);
  std::vector<float> row(static_cast<std::size_t>(plan.width) *
                         static_cast<std::size_t>(plan.channels));
  for (int y = 0; y < plan.height; ++y) {
    read_row(pixels, y, row.data());
    encoder.add(y, row.data());
  }
  build_pyramid(plan, words.span());
}

}  // namespace nacre
