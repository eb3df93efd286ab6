#include "pbs/bsdf.h"

namespace nacre {

namespace {

/// x y, but nothing where either is a literal zero.
Color3 product(Color3 x, Color3 y) {
  const auto one = [](Float a, Float b) {
    if (a.is_constant(0.0f) || b.is_constant(0.0f)) return Float(0.0f);
    return a * b;
  };
  return {one(x.x, y.x), one(x.y, y.y), one(x.z, y.z)};
}

void flatten_child(const BsdfPtr& child, const View& view, Color3 weight,
                   std::vector<WeightedLobe>& lobes) {
  if (child != nullptr && !is_zero(weight)) child->flatten(view, weight, lobes);
}

/// Interiors: what light loses and gains on its way between two points of the surface.
void report_medium(const Vdf& medium, LeftOut& left_out) {
  if (!is_zero(medium.absorption)) {
    left_out.add("interior medium: absorption, so depth does not tint (transmission_depth)");
  }
  if (!is_zero(medium.scattering)) left_out.add("interior medium: scattering");
}

/// An unconnected BSDF is not there: everything passes.
Color3 throughput_of(const BsdfPtr& child, const View& view) {
  return child == nullptr ? Color3(1.0f) : child->throughput(view);
}

}  // namespace

void LobeBsdf::flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const {
  const Color3 total = product(weight, Color3(weight_));
  if (is_zero(total)) return;
  if (view.left_out != nullptr) {
    for (const std::string& line : left_out_) view.left_out->add(line);
  }
  lobe_->prepare(view, max_component(total) > 0.0f);
  lobes.push_back({lobe_, total});
}

Color3 LobeBsdf::throughput(const View& view) const {
  if (lobe_->is_opaque()) return Color3(0.0f);
  if (weight_.is_constant(0.0f)) return Color3(1.0f);
  const Color3 lost = Color3(1.0f) - lobe_->throughput(view);
  return saturate(Color3(1.0f) - product(Color3(weight_), lost));
}

void LayerBsdf::flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const {
  flatten_child(top_, view, weight, lobes);
  if (medium_ != nullptr && view.left_out != nullptr && !view.thin_walled.is_constant(true)) {
    report_medium(*medium_, *view.left_out);
  }
  if (base_ == nullptr) return;
  flatten_child(base_, view, product(weight, throughput_of(top_, view)), lobes);
}

Color3 LayerBsdf::throughput(const View& view) const {
  return product(throughput_of(top_, view), throughput_of(base_, view));
}

void MixBsdf::flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const {
  flatten_child(fg_, view, product(weight, Color3(mix_)), lobes);
  flatten_child(bg_, view, product(weight, Color3(1.0f - mix_)), lobes);
}

Color3 MixBsdf::throughput(const View& view) const {
  if (mix_.is_constant(0.0f)) return throughput_of(bg_, view);
  if (mix_.is_constant(1.0f)) return throughput_of(fg_, view);
  return lerp(throughput_of(bg_, view), throughput_of(fg_, view), mix_);
}

void AddBsdf::flatten(const View& view, Color3 weight, std::vector<WeightedLobe>& lobes) const {
  flatten_child(in1_, view, weight, lobes);
  flatten_child(in2_, view, weight, lobes);
}

Color3 AddBsdf::throughput(const View& view) const {
  // What one term takes away, the sum takes away: 1 - ((1 - t1) + (1 - t2)).
  const Color3 sum = throughput_of(in1_, view) + throughput_of(in2_, view);
  return max(sum - Color3(1.0f), Color3(0.0f));
}

void MultiplyBsdf::flatten(const View& view, Color3 weight,
                           std::vector<WeightedLobe>& lobes) const {
  flatten_child(in1_, view, product(weight, tint_), lobes);
}

Color3 MultiplyBsdf::throughput(const View& view) const { return throughput_of(in1_, view); }

BsdfPtr as_bsdf(const ClosurePtr& closure) {
  return std::dynamic_pointer_cast<const Bsdf>(closure);
}

}  // namespace nacre
