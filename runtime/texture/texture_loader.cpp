#include "runtime/texture/texture_loader.h"

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

std::optional<Diagnostic> load_texture(ImageReader& reader, const Plan& plan, AlignedWords& words,
                                       std::uint64_t& replaced) {
  write_header(plan, 0, words.span());
  std::uint32_t* const base = words.span().data();
  const auto channels = static_cast<std::size_t>(plan.channels);
  auto problem = reader.read([&](int from_top, const float* samples) {
    const int y = plan.height - 1 - from_top;
    for (int x = 0; x < plan.width; ++x, samples += channels) {
      Rgba texel{0.f, 0.f, 0.f, 1.f};
      for (std::size_t c = 0; c < channels; ++c) texel[c] = sanitised(samples[c], replaced);
      encode_texel(plan.format, texel, base + texel_index(plan, 0, x, y));
    }
  });
  if (!problem) build_pyramid(plan, words.span());
  return problem;
}

}  // namespace nacre
