#include "bench/textures/ours.h"

#include <array>
#include <utility>

#include "bench/common/system.h"
#include "jit/record/textures.h"
#include "nodes/texture2d/sampler.h"
#include "runtime/node/drawn_texels.h"
#include "runtime/node/geometry.h"

namespace nacre::bench {

std::unique_ptr<OurTexture> OurTexture::make(const std::string& path, Filter filter, bool draws,
                                             const CompileOptions& options, std::string& error) {
  static TextureStore store;
  Diagnostics diagnostics;
  Recorder recorder;
  auto textures = std::make_shared<RecordedTextures>(store, recorder, diagnostics);
  if (draws) offer_drawn_texels(recorder);
  ImageLookup lookup;
  lookup.uv = texcoord(recorder, 0);
  if (filter == Filter::closest) lookup.modes.filter = TextureFilter::closest;
  const Float4 rgba = sample_images(recorder, textures->find(path, {}), lookup);
  const std::array<SliceOutput, 4> outputs{
      {{"r", rgba.x.ref()}, {"g", rgba.y.ref()}, {"b", rgba.z.ref()}, {"a", rgba.w.ref()}}};
  auto kernel = compile(slice(recorder.program(), "texture", outputs), options, &compile_service(),
                        diagnostics);
  error = diagnostics.to_string();
  if (kernel == nullptr || !error.empty()) return nullptr;
  return std::unique_ptr<OurTexture>(new OurTexture(BoundKernel(std::move(kernel), textures)));
}

const float* OurTexture::channel(const std::string& name, const Lookups& points,
                                 std::size_t first) const {
  if (name == "uv0.x") return points.u.data() + first;
  if (name == "uv0.y") return points.v.data() + first;
  if (name == drawn_texels_channel) return points.draw.data() + first;
  if (name == "duv0dx.x") return long_axis_.data();
  if (name == "duv0dy.y") return footprint_.data();
  return zero_.data();
}

void OurTexture::look_up(const Lookups& points, std::size_t first, std::size_t count,
                         Rgba& rgba) const {
  if (footprint_.size() != count || footprint_.front() != points.footprint) {
    footprint_.assign(count, points.footprint);
    long_axis_.assign(count, points.aspect * points.footprint);
    zero_.assign(count, 0.0f);
  }
  std::array<const void*, 7> inputs{};
  const auto& channels = kernel_.program().inputs;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    inputs[k] = channel(channels[k].name, points, first);
  }
  const std::array<void*, 4> outputs{rgba[0].data(), rgba[1].data(), rgba[2].data(),
                                     rgba[3].data()};
  (void)kernel_.run({inputs.data(), channels.size()}, outputs, count);
}

}  // namespace nacre::bench
