#include "examples/tool/render/lobe_parts.h"

#include <algorithm>
#include <string>

#include "runtime/channel/channel_name.h"

namespace nacre::tool {

namespace {

using host::ScatterClass;

ScatterClass class_of(const LobeInfo& lobe) {
  if (lobe.name == "subsurface_bsdf") return ScatterClass::subsurface;
  if ((lobe.kinds & lobe_diffuse_reflection) != 0) return ScatterClass::diffuse;
  return ScatterClass::glossy;
}

bool is_other_side(const host::ShadingBatch& batch, const host::Lanes3& wi, std::size_t i) {
  const auto side = [&](const host::Lanes3& w) {
    return batch.Ng.x[i] * w.x[i] + batch.Ng.y[i] * w.y[i] + batch.Ng.z[i] * w.z[i] < 0.f;
  };
  return side(wi) != side(batch.wo);
}

}  // namespace

LobeParts::LobeParts(const Program& program, std::string_view result,
                     const std::vector<LobeInfo>& lobes) {
  const std::string head = std::string(result) + ".lobe";
  const bool is_by_lobe = std::ranges::any_of(
      program.outputs, [&](const Channel& output) { return output.name.starts_with(head); });
  if (!is_by_lobe) return;
  for (const LobeInfo& lobe : lobes) classes_.push_back(class_of(lobe));
}

void LobeParts::add(const host::ShadingBatch& batch, host::Lanes3 wi, const std::uint32_t* flags,
                    const float* lobes, std::size_t stride, const host::PartLanes& parts) const {
  for (const host::Lanes3& part : parts) {
    for (float* x : {part.x, part.y, part.z}) std::fill_n(x, batch.count, 0.f);
  }
  for (std::size_t k = 0; k < classes_.size(); ++k) {
    const float* const rgb[3] = {lobes + 3 * k * stride, lobes + (3 * k + 1) * stride,
                                 lobes + (3 * k + 2) * stride};
    for (std::size_t i = 0; i < batch.count; ++i) {
      ScatterClass is = classes_[k];
      if (is != ScatterClass::subsurface && is_other_side(batch, wi, i)) {
        is = ScatterClass::transmission;
      } else if (is == ScatterClass::glossy && flags != nullptr &&
                 (flags[i] & host::sample_delta) != 0) {
        is = ScatterClass::mirror;
      }
      const host::Lanes3& part = parts[static_cast<std::size_t>(is)];
      part.x[i] += rgb[0][i];
      part.y[i] += rgb[1][i];
      part.z[i] += rgb[2][i];
    }
  }
}

}  // namespace nacre::tool
