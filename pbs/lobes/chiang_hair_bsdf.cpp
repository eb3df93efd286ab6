#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "pbs/bsdf.h"
#include "pbs/facets.h"
#include "pbs/per_view.h"
#include "pbs/sampling.h"

namespace nacre {

namespace {

/// Ways of light through a fibre: reflected (R), straight through (TT), reflected once inside
/// (TRT), and all longer ones together.
constexpr std::size_t ways = 4;

/// e^-x I0(x), x >= 0. Abramowitz and Stegun, 9.8.1 and 9.8.2: errors below 2e-7.
Float scaled_bessel(Float x) {
  constexpr float joint = 3.75f;
  const auto polynomial = [](Float t, auto coefficients) {
    Float sum = 0.0f;
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = fma(sum, t, coefficients[i]);
    return sum;
  };
  const Float small = polynomial(
      square(x * (1.0f / joint)),
      std::array{1.0f, 3.5156229f, 3.0899424f, 1.2067492f, 0.2659732f, 0.0360768f, 0.0045813f});
  const Float inverse = joint / max(x, joint);
  const Float large = polynomial(
      inverse, std::array{0.39894228f, 0.01328592f, 0.00225319f, -0.00157565f, 0.00916281f,
                          -0.02057706f, 0.02635537f, -0.01647633f, 0.00392377f});
  return select(x < joint, small * exp(-min(x, joint)), large / sqrt(max(x, joint)));
}

/// 1 - e^-x, x >= 0, without cancellation: of rough fibres x is small.
Float one_less_exp(Float x) {
  const Float series =
      x * fma(x, fma(x, fma(x, fma(x, 1.0f / 120.0f, -1.0f / 24.0f), 1.0f / 6.0f), -0.5f), 1.0f);
  return select(x < 0.25f, series, 1.0f - exp(-x));
}

/// -log(1 - y), y in [0, 1], of which the rest to 1 is given too.
Float less_log(Float y, Float rest) {
  Float series = 1.0f / 6.0f;
  for (const float one : {0.2f, 0.25f, 1.0f / 3.0f, 0.5f, 1.0f}) series = fma(series, y, one);
  return select(y < 0.1f, series * y, -log(rest));
}

/// The longitudinal density M of d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model",
/// eq. 7, per cosine. I0(a) / sinh(1/v) as it stands overflows, and its logarithm loses all digits
/// of small variances: here what cancels is taken out, so that no exponent is positive.
Float longitudinal(Float sin_i, Float cos_i, Float sin_o, Float cos_o, Float variance) {
  const Float inverse = 1.0f / variance;
  const Float apart = fma(sin_i + sin_o, sin_i + sin_o, square(cos_i - cos_o));
  const Float bessel = scaled_bessel(cos_i * cos_o * inverse);
  return bessel * exp(-0.5f * apart * inverse) * inverse / one_less_exp(2.0f * inverse);
}

/// exp(-pi / s): what of a logistic density is beyond half a turn.
Float beyond(Float scale) { return exp(-pi / scale); }

/// The azimuthal density of a way: a logistic about 0, within half a turn (Chiang et al. 2016).
Float azimuthal(Float angle, Float scale) {
  const Float x = exp(-abs(angle) / scale);
  const Float all = (1.0f - beyond(scale)) / (1.0f + beyond(scale));
  return x / (scale * square(1.0f + x) * all);
}

/// An angle by its cosine and sine, or by what is proportional to both: sums of angles keep the
/// digits that a narrow logistic asks for, in every mode, where radians are 2.4e-7 apart.
struct Turn {
  Float cosine, sine;

  Turn operator+(Turn other) const {
    return {fma(cosine, other.cosine, -(sine * other.sine)),
            fma(sine, other.cosine, cosine * other.sine)};
  }
  Turn operator-() const { return {cosine, -sine}; }
  /// Of length 1, where it is nearly so.
  Turn unit() const {
    const Float scale = fma(fma(cosine, cosine, square(sine)), -0.5f, 1.5f);
    return {cosine * scale, sine * scale};
  }
  Turn reversed() const { return {-cosine, -sine}; }  ///< By half a turn.
  Float radians() const { return atan2(sine, cosine); }
};

Turn select(Bool condition, Turn a, Turn b) {
  return {nacre::select(condition, a.cosine, b.cosine), nacre::select(condition, a.sine, b.sine)};
}

/// What lies less across the fibre has no azimuth.
constexpr float least_across = 1e-6f;

/// A direction by the fibre: its elevation from the plane across, and what is in that plane.
struct Along {
  Float sine, cosine;
  Float y, z;  ///< Times the cosine.
};

Along along(const Frame& frame, Float3 w) {
  const Float3 local = frame.to_local(w);
  return {.sine = clamp(local.x, -1.0f, 1.0f),
          .cosine = sqrt(fma(local.y, local.y, square(local.z))),
          .y = local.y,
          .z = local.z};
}

/// Chiang, Bitterli, Tappan and Burley, "A Practical and Controllable Hair and Fur Model for
/// Production Path Tracing", Eurographics 2016. x is the fibre's direction, and the shading normal
/// says where on the fibre the point is: the model is that of a near field, and not reciprocal.
/// White fibres without absorption return all light, for each way's density is normalised.
class ChiangHair final : public Lobe {
 public:
  struct Inputs {
    Float3 normal, direction;
    std::array<Color3, 3> tint;        ///< In [0, 1e6].
    std::array<Float, 3> variance;     ///< Longitudinal, in [5e-7, 1000].
    std::array<Float, 3> scale;        ///< Of the logistic, in [6e-4, 10].
    std::array<Float, 3> tilt_sine;    ///< Of the cuticle's angle, as each way sees it.
    std::array<Float, 3> tilt_cosine;  ///< The same.
    Float index;                       ///< In [1, 50].
    Color3 absorption;                 ///< Per radius, in [0, 1e6].
  };
  /// All kept.
  explicit ChiangHair(const Inputs& inputs) : in_(inputs) {}

  std::string_view name() const override { return "chiang_hair_bsdf"; }
  std::int32_t kinds() const override { return lobe_glossy_reflection | lobe_glossy_transmission; }
  bool is_opaque() const override { return true; }
  bool is_of_fibre() const override { return true; }

  void prepare(const View& view, Bool mask) const override {
    terms_.prepare(view, mask, [&] { return compute(view); });
  }

  LobeValue evaluate(const View& view, Float3 wi_world) const override {
    const Terms terms = get(view);
    const Along wi = along(frame(view), wi_world);
    // Along the fibre it has no azimuth but that of its rounding, which is another in each kernel
    // of `fast`: one is taken, as of wo.
    const Bool is_across = wi.cosine > least_across;
    const Turn turn =
        Turn{select(is_across, wi.y, 0.0f), select(is_across, wi.z, 1.0f)} + -terms.across;
    const std::array exits = exits_of(terms);
    Color3 f = Color3(0.0f);
    Float pdf = 0.0f;
    for (std::size_t way = 0; way < ways; ++way) {
      const auto [sine, cosine] = tilted(terms, way);
      const Float m = longitudinal(wi.sine, wi.cosine, sine, cosine, variance(way));
      const Float n = way == 3 ? Float(0.5f * one_over_pi)
                               : azimuthal((turn + -exits[way]).radians(), in_.scale[way]);
      const Float density = finite(m * n);
      f = fma(terms.share[way], Color3(density), f);
      pdf = fma(terms.chance[way], density, pdf);
    }
    const Bool seen = is_unit(wi_world) & (pdf > 0.0f);
    return {.f = select(seen, f, Color3(0.0f)), .pdf = select(seen, pdf, 0.0f)};
  }

  LobeSample sample(const View& view, Float3 u) const override {
    const Terms terms = get(view);
    const std::array exits = exits_of(terms);
    Float below = 0.0f, rest = 0.5f, v = 1.0f, s = 1.0f, sine = 0.0f, cosine = 1.0f;
    Turn exit{1.0f, 0.0f};
    Bool uniform = false;
    for (std::size_t way = 0; way < ways; ++way) {
      const Float chance = terms.chance[way];
      const Bool mine = (u.z >= below) & (u.z < below + chance);
      const auto [way_sine, way_cosine] = tilted(terms, way);
      rest = select(mine, min(max((u.z - below) / chance, 0.0f), 0x1.fffffep-1f), rest);
      v = select(mine, variance(way), v);
      sine = select(mine, way_sine, sine), cosine = select(mine, way_cosine, cosine);
      if (way < 3) {
        s = select(mine, in_.scale[way], s);
        exit = select(mine, exits[way], exit);
      } else {
        uniform = mine;
      }
      below = below + chance;
    }
    // d'Eon et al. 2013, "Importance Sampling for Physically-Based Hair Fiber Models".
    const Float back = u.x * one_less_exp(2.0f / v);
    const Float height = v * less_log(back, fma(u.x, exp(-2.0f / v), 1.0f - u.x));  // 1 - cosine.
    const Float slant = safe_sqrt(height * (2.0f - height)) * on_circle(u.y).x;
    const Float sin_i = clamp(fma(height - 1.0f, sine, slant * cosine), -1.0f, 1.0f);
    const Float cos_i = safe_sqrt((1.0f - sin_i) * (1.0f + sin_i));
    const Float tail = beyond(s) / (1.0f + beyond(s));
    const Float q = clamp(fma(rest, fma(-2.0f, tail, 1.0f), tail), 1e-8f, 1.0f - 0x1p-24f);
    const Float logistic = clamp(s * log(q / (1.0f - q)), -pi, pi);
    const Float from_exit = select(uniform, 2.0f * pi * rest, logistic);
    Turn out = terms.across + exit + Turn{cos(from_exit), sin(from_exit)};
    // In `fast` it is not of length 1, nor would be what is across the fibre: light would leave
    // nearer to it than the density says (narrow_test.cpp has by how much of the narrowest lobe).
    if (view.accuracy == Accuracy::fast) out = out.unit();
    const Float3 local{sin_i, cos_i * out.cosine, cos_i * out.sine};
    const Float3 wi = frame(view).to_world(local);
    return {.wi = wi, .valid = below > 0.0f};
  }

  Color3 albedo(const View& view) const override {
    const Terms terms = get(view);
    Color3 sum = Color3(0.0f);
    for (const Color3& share : terms.share) sum = sum + share;
    return saturate(sum);
  }
  Color3 throughput(const View&) const override { return Color3(0.0f); }
  Float3 normal(const View&) const override { return in_.normal; }
  Float roughness(const View&) const override { return sqrt(min(in_.scale[0], 1.0f)); }

 private:
  /// What depends on wo.
  struct Terms {
    Float sine, cosine;                ///< Of its elevation.
    Turn across;                       ///< Its direction across the fibre, from the bitangent.
    Turn inside;                       ///< In it, the angle to the normal across the fibre.
    std::array<Color3, ways> share{};  ///< Of the light, tinted.
    std::array<Float, ways> chance{};  ///< To be sampled.
    template <class F>
    friend void visit(Terms& terms, F&& f) {
      f(terms.sine), f(terms.cosine), f(terms.across.cosine), f(terms.across.sine);
      f(terms.inside.cosine), f(terms.inside.sine);
      for (Color3& each : terms.share) nacre::visit(each, f);
      for (Float& each : terms.chance) f(each);
    }
  };

  Frame frame(const View& view) const {
    return make_frame(facing(in_.normal, view.wo), in_.direction);
  }
  Terms get(const View& view) const {
    return terms_.get(view, [&] { return compute(view); });
  }
  Float variance(std::size_t way) const { return in_.variance[std::min<std::size_t>(way, 2)]; }

  /// The elevation that a way starts from: the cuticle is tilted against the fibre.
  std::pair<Float, Float> tilted(const Terms& terms, std::size_t way) const {
    if (way == 3) return {terms.sine, terms.cosine};
    const Float sine = in_.tilt_sine[way], cosine = in_.tilt_cosine[way];
    return {fma(terms.sine, cosine, terms.cosine * sine),
            abs(fma(terms.cosine, cosine, -(terms.sine * sine)))};
  }
  /// Where ways leave, from wo on: by -2 of the angle to the normal, and for each way through the
  /// fibre by half a turn and 2 of the angle inside (Marschner et al. 2003, section 4).
  static std::array<Turn, 3> exits_of(const Terms& terms) {
    const Turn outside{terms.across.sine, -terms.across.cosine};
    const Turn through = (terms.inside + terms.inside).reversed();
    const Turn reflected = -(outside + outside);
    const Turn passed = reflected + through;
    return {reflected, passed, passed + through};
  }

  Terms compute(const View& view) const {
    const Along wo = along(frame(view), view.wo);
    Terms terms;
    terms.sine = wo.sine, terms.cosine = wo.cosine;
    const Bool is_across = wo.cosine > least_across;
    terms.across = {select(is_across, wo.y / wo.cosine, 0.0f),
                    select(is_across, wo.z / wo.cosine, 1.0f)};
    // Across the fibre light bends as if the index were larger: Bravais (Marschner et al. 2003).
    const Float index = sqrt(max(fma(in_.index, in_.index, -square(wo.sine)), 0.0f));
    const Float sin_t = clamp(-terms.across.cosine * wo.cosine / max(index, 1e-6f), -1.0f, 1.0f);
    const Float cos_t = safe_sqrt((1.0f - sin_t) * (1.0f + sin_t));
    terms.inside = {cos_t, sin_t};
    const Float straight = max(safe_sqrt(1.0f - square(wo.sine / in_.index)), 1e-6f);
    const Float path = 2.0f * cos_t / straight;
    const auto passes = [&](Float absorption) { return exp(-absorption * path); };
    const Color3 passed{passes(in_.absorption.x), passes(in_.absorption.y),
                        passes(in_.absorption.z)};
    share_out(terms, fresnel_dielectric(saturate(wo.cosine * terms.across.sine), in_.index),
              passed);
    return terms;
  }

  /// As Chiang et al. 2016 do: the longer ways are a geometric series.
  void share_out(Terms& terms, Float reflected, Color3 passed) const {
    const Float enters = 1.0f - reflected;
    const Color3 inside = passed * Color3(reflected);
    Color3 light = Color3(reflected);
    Float total = 0.0f;
    for (std::size_t way = 0; way < ways; ++way) {
      if (way == 1) light = Color3(square(enters)) * passed;
      if (way == 2) light = light * inside;
      if (way == 3) light = light * inside / max(Color3(1.0f) - inside, Color3(1e-7f));
      terms.share[way] = light * in_.tint[std::min<std::size_t>(way, 2)];
      terms.chance[way] = grey(terms.share[way]);
      total = total + terms.chance[way];
    }
    const Float scale = select(total > 0.0f, 1.0f / total, 0.0f);
    for (Float& chance : terms.chance) chance = chance * scale;
  }

  Inputs in_;
  PerView<Terms> terms_;
};

}  // namespace

/// chiang_hair_bsdf. MaterialX 1.39.5 data library; it has no weight. cuticle_angle: 0.5 is none, 0
/// and 1 a quarter turn. Inputs are clamped as ChiangHair::Inputs says; roughnesses are those of
/// chiang_hair_roughness, whose scale is Chiang's s: the standard deviation of a logistic with
/// s sqrt(pi / 8).
void record_closure_chiang_hair_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  ChiangHair::Inputs in;
  in.normal = prepare_normal(recorder, call.vector3("normal"));
  in.direction = keep(recorder, call.vector3("curve_direction"));
  in.index = keep(recorder, clamp(call.number("ior"), 1.0f, 50.0f));
  in.absorption = prepare_tint(recorder, call.vector3("absorption_coefficient"));
  const Float tilt = fma(saturate(call.number("cuticle_angle")), pi, -0.5f * pi);
  constexpr std::array names{"R", "TT", "TRT"};
  constexpr float root_eighth_pi = 0.626657069f;
  for (std::size_t way = 0; way < names.size(); ++way) {
    const std::string name = names[way];
    in.tint[way] = prepare_tint(recorder, call.vector3("tint_" + name));
    const Float2 roughness = call.vector2("roughness_" + name);
    in.variance[way] = keep(recorder, clamp(roughness.x, 5e-7f, 1e3f));
    in.scale[way] = keep(recorder, clamp(roughness.y, 1e-3f, 16.0f) * root_eighth_pi);
    // By 2, -1 and -4 times the angle, as the data library's text has it.
    const Float angle = (2.0f - 3.0f * static_cast<float>(way)) * tilt;
    in.tilt_sine[way] = keep(recorder, sin(angle));
    in.tilt_cosine[way] = keep(recorder, cos(angle));
  }
  call.set(
      std::make_shared<LobeBsdf>(std::make_shared<ChiangHair>(in), Float(1.0f), recorder.origin()));
}

}  // namespace nacre
