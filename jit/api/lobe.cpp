#include "jit/api/lobe.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "jit/api/call.h"
#include "pbs/bsdf.h"
#include "runtime/node/geometry.h"

namespace nacre::api {

namespace {

/// A lobe whose functions are a host's. What they give is checked and held to what Lobe promises
/// of types; of ranges they must see themselves.
class HostLobe final : public Lobe {
 public:
  HostLobe(const nacre_lobe& lobe, Diagnostics& diagnostics, SourceLocation where)
      : lobe_(lobe),
        name_(text_or_empty(lobe.name)),
        user_(lobe.user,
              [destroy = lobe.destroy](void* user) {
                if (destroy != nullptr) destroy(user);
              }),
        diagnostics_(diagnostics),
        where_(std::move(where)) {}

  std::string_view name() const override { return name_; }
  std::int32_t kinds() const override { return lobe_.kinds & lobe_all; }
  bool is_opaque() const override { return lobe_.is_opaque != 0; }

  LobeValue evaluate(const View& view, Float3 wi) const override {
    Recording recording(*view.recorder, diagnostics_, where_);
    const nacre_view seen = seen_from(view, recording);
    const Three direction = give(recording, wi);
    Three f = zeros();
    nacre_value pdf = zero();
    lobe_.evaluate(user_.get(), &seen, direction.data(), f.data(), &pdf);
    return {.f = take(recording, f.data(), "f"),
            .pdf = Float(recording.take(pdf, Scalar::f32, "pdf"))};
  }

  LobeSample sample(const View& view, Float3 u) const override {
    Recording recording(*view.recorder, diagnostics_, where_);
    const nacre_view seen = seen_from(view, recording);
    const Three numbers = give(recording, u);
    nacre_lobe_sample made{};
    made.size = sizeof made;
    made.valid = made.delta = {nullptr, 0, NACRE_BOOL};
    lobe_.sample(user_.get(), &seen, numbers.data(), &made);
    return {.wi = take(recording, made.wi, "wi"),
            .valid = Bool(recording.take(made.valid, Scalar::b1, "valid")),
            .delta = Bool(recording.take(made.delta, Scalar::b1, "delta")),
            .delta_weight = take(recording, made.delta_weight, "delta_weight"),
            .delta_probability =
                Float(recording.take(made.delta_probability, Scalar::f32, "delta_probability"))};
  }

  bool checks_samples() const override { return true; }  // What a host says is left as it is.

  Color3 albedo(const View& view) const override { return three(lobe_.albedo, view, "albedo"); }

  Color3 throughput(const View& view) const override {
    if (lobe_.throughput != nullptr) return three(lobe_.throughput, view, "throughput");
    if (is_opaque()) return Color3(0.0f);
    const Color3 kept = albedo(view);
    return {1.0f - kept.x, 1.0f - kept.y, 1.0f - kept.z};
  }

  Float3 normal(const View& view) const override {
    if (lobe_.normal == nullptr) return nacre::normal(*view.recorder, Space::world);
    return three(lobe_.normal, view, "normal");
  }

  Float roughness(const View& view) const override {
    if (lobe_.roughness == nullptr) return 1.0f;
    Recording recording(*view.recorder, diagnostics_, where_);
    const nacre_view seen = seen_from(view, recording);
    nacre_value number = zero();
    lobe_.roughness(user_.get(), &seen, &number);
    return Float(recording.take(number, Scalar::f32, "roughness"));
  }

 private:
  using Three = std::array<nacre_value, 3>;

  static nacre_value zero() { return {nullptr, 0, NACRE_FLOAT}; }
  static Three zeros() { return {zero(), zero(), zero()}; }
  static Three give(Recording& recording, Float3 v) {
    return {recording.give(v.x.ref()), recording.give(v.y.ref()), recording.give(v.z.ref())};
  }
  static Float3 take(Recording& recording, const nacre_value* values, const char* what) {
    return {Float(recording.take(values[0], Scalar::f32, what)),
            Float(recording.take(values[1], Scalar::f32, what)),
            Float(recording.take(values[2], Scalar::f32, what))};
  }
  static nacre_view seen_from(const View& view, Recording& recording) {
    nacre_view seen{};
    seen.size = sizeof seen;
    seen.recorder = recording.handle();
    const Three wo = give(recording, view.wo);
    std::copy(wo.begin(), wo.end(), seen.wo);
    seen.accuracy = accuracy_number(view.accuracy);
    seen.thin_walled = recording.give(view.thin_walled.ref());
    return seen;
  }
  Color3 three(void (*function)(void*, const nacre_view*, nacre_value*), const View& view,
               const char* what) const {
    Recording recording(*view.recorder, diagnostics_, where_);
    const nacre_view seen = seen_from(view, recording);
    Three rgb = zeros();
    function(user_.get(), &seen, rgb.data());
    return take(recording, rgb.data(), what);
  }

  const nacre_lobe lobe_;
  const std::string name_;
  const std::shared_ptr<void> user_;
  /// Of the call that compiles, which the recording ends before.
  Diagnostics& diagnostics_;
  const SourceLocation where_;
};

}  // namespace

int accuracy_number(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::precise: return NACRE_PRECISE;
    case Accuracy::standard: return NACRE_STANDARD;
    case Accuracy::fast: return NACRE_FAST;
  }
  return NACRE_STANDARD;
}

void set_host_lobe(NodeCall& call, const nacre_lobe& given, Recording& recording) {
  const nacre_lobe lobe = options_of(&given);
  if (lobe.evaluate == nullptr || lobe.sample == nullptr || lobe.albedo == nullptr) {
    recording.fail("a lobe lacks a function", "evaluate, sample and albedo");
    if (lobe.destroy != nullptr) lobe.destroy(lobe.user);
    return;
  }
  set_lobe(call, std::make_shared<HostLobe>(lobe, call.diagnostics(), call.where()));
}

}  // namespace nacre::api
