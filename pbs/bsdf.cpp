#include "pbs/bsdf.h"

#include <utility>

#include "runtime/node/node_call.h"

namespace nacre {

namespace {

/// Interiors: what light loses and gains on its way between two points of the surface.
void report_medium(const Vdf& medium, LeftOut& left_out) {
  if (!is_zero(medium.absorption)) {
    left_out.add("interior medium: absorption, so depth does not tint (transmission_depth)");
  }
  if (!is_zero(medium.scattering)) left_out.add("interior medium: scattering");
}

}  // namespace

Color3 LobeBsdf::part_weight(std::size_t, Color3, const Throughput&) const { return Color3(0.0f); }

Color3 LobeBsdf::throughput(const View& view, Color3, Color3) const {
  if (lobe_->is_opaque()) return Color3(0.0f);
  if (weight().is_constant(0.0f)) return Color3(1.0f);
  const Color3 of_lobe = lobe_->throughput(view);
  if (weight().is_constant(1.0f)) return of_lobe;
  // 1 - w (1 - throughput), which is the throughput itself to the bit where w is 1.
  return saturate(fma(Color3(weight()), of_lobe, Color3(1.0f - weight())));
}

BsdfPtr LobeBsdf::with_lobe(LobePtr lobe) const {
  return std::make_shared<LobeBsdf>(std::move(lobe), weight_, origin_);
}

void LobeBsdf::report(const View& view, Color3) const {
  if (view.left_out == nullptr || view.follows_subsurface || !lobe_->goes_below()) return;
  view.left_out->add(std::string(lobe_->name()) +
                     ": radius and anisotropy; light leaves where it enters");
}

void set_lobe(NodeCall& call, LobePtr lobe, bool is_nothing) {
  Recorder& recorder = call.recorder();
  const Float weight = keep(recorder, clamp(call.number("weight"), 0.0f, 1e6f));
  call.set(std::make_shared<LobeBsdf>(std::move(lobe), weight, recorder.origin(), is_nothing));
}

Color3 LayerBsdf::part_weight(std::size_t i, Color3 weight, const Throughput& passes) const {
  return i == 0 ? weight : product(weight, passes(parts()[0]));
}

Color3 LayerBsdf::throughput(const View&, Color3 top, Color3 base) const {
  return product(top, base);
}

BsdfPtr LayerBsdf::with_parts(BsdfPtr top, BsdfPtr base) const {
  return std::make_shared<LayerBsdf>(std::move(top), std::move(base), medium_);
}

void LayerBsdf::report(const View& view, Color3 weight) const {
  if (medium_ == nullptr || view.thin_walled.is_constant(true)) return;
  if (view.media != nullptr) {
    view.media->push_back({medium_, weight});
  } else if (view.left_out != nullptr) {
    report_medium(*medium_, *view.left_out);
  }
}

Color3 MixBsdf::part_weight(std::size_t i, Color3 weight, const Throughput&) const {
  return product(weight, Color3(i == 0 ? mix_ : 1.0f - mix_));
}

bool MixBsdf::shades(std::size_t i) const {
  return Bsdf::shades(i) && !mix_.is_constant(i == 0 ? 0.0f : 1.0f);
}

Color3 MixBsdf::throughput(const View&, Color3 fg, Color3 bg) const {
  if (mix_.is_constant(0.0f)) return bg;
  if (mix_.is_constant(1.0f)) return fg;
  return lerp(bg, fg, mix_);
}

BsdfPtr MixBsdf::with_parts(BsdfPtr fg, BsdfPtr bg) const {
  return std::make_shared<MixBsdf>(std::move(fg), std::move(bg), mix_);
}

Color3 AddBsdf::part_weight(std::size_t, Color3 weight, const Throughput&) const { return weight; }

Color3 AddBsdf::throughput(const View&, Color3 in1, Color3 in2) const {
  // What one term takes away, the sum takes away: 1 - ((1 - t1) + (1 - t2)).
  return max(in1 + in2 - Color3(1.0f), Color3(0.0f));
}

BsdfPtr AddBsdf::with_parts(BsdfPtr in1, BsdfPtr in2) const {
  return std::make_shared<AddBsdf>(std::move(in1), std::move(in2));
}

Color3 MultiplyBsdf::part_weight(std::size_t, Color3 weight, const Throughput&) const {
  return product(weight, tint_);
}

bool MultiplyBsdf::blackens() const {
  const auto may_be_zero = [](Float x) { return !x.is_constant() || x.constant() <= 0.0f; };
  return may_be_zero(tint_.x) || may_be_zero(tint_.y) || may_be_zero(tint_.z);
}

Color3 MultiplyBsdf::throughput(const View&, Color3 in1, Color3) const { return in1; }

BsdfPtr MultiplyBsdf::with_parts(BsdfPtr in1, BsdfPtr) const {
  return std::make_shared<MultiplyBsdf>(std::move(in1), tint_);
}

BsdfPtr as_bsdf(const ClosurePtr& closure) {
  return std::dynamic_pointer_cast<const Bsdf>(closure);
}

}  // namespace nacre
