#include <array>

#include "pbs/bsdf.h"
#include "pbs/facets.h"
#include "pbs/per_view.h"
#include "pbs/sampling.h"

namespace nacre {

namespace {

/// Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017
/// course notes: the distribution (2 + 1/r) sin^(1/r) / (2 pi) of cloth fibres, with
/// the shadowing of the data library's shader, 1 / (4 (ci + co - ci co)).
///
/// As published it reflects more light than arrives at low roughness and grazing
/// angles: twice as much at 0.02. Here roughness is at least 0.07, and what
/// exceeds 1 (at most 1.58, and nothing from roughness 0.21 on) is divided out for the view.
/// Reciprocal but for that.
constexpr float lowest_roughness = 0.07f;

/// Coefficients of a polynomial of total degree 5 in two variables: row i belongs
/// to the first one's power i, its entries to powers of the second.
using Rows = std::array<std::array<float, 6>, 6>;

/// Fitted to quadrature over roughness 0.07 to 1 and all angles; largest error of
/// the quotient 6e-4.
constexpr Rows numerator{
    {{4.54325826f, 34.3120147f, 76.2254497f, 245.042762f, -216.98746f, 24.244457f},
     {11.0202813f, 177.477085f, 615.600381f, 40.4679699f, 45.5714987f},
     {-117.786234f, -727.718633f, -736.404372f, 94.853103f},
     {240.376554f, 683.090676f, -25.974881f},
     {-190.633397f, -162.301494f},
     {52.3606517f}}};
constexpr Rows denominator{{{1.0f, 46.5061585f, 48.4422685f, 518.304974f, -387.381086f, 36.176118f},
                            {3.20491226f, 138.170905f, 925.068689f, 506.220651f, -162.950143f},
                            {-0.247419131f, -635.331451f, -32.0204437f, 130.076703f},
                            {6.770827f, 616.163076f, -493.220115f},
                            {-32.3769582f, -67.8522539f},
                            {16.8963252f}}};

Float polynomial(const Rows& rows, Float x, Float y) {
  Float sum = 0.0f;
  for (std::size_t i = rows.size(); i-- > 0;) {
    Float row = 0.0f;
    for (std::size_t k = rows.size() - i; k-- > 0;) row = fma(row, y, rows[i][k]);
    sum = fma(sum, x, row);
  }
  return sum;
}

/// x in [0, 1] raised to a positive exponent. pow() has digits more, lest the exponent's product
/// rounds; what lobes promise in `standard` does without (rounding_test.cpp).
Float raise(Float x, Float exponent, Accuracy accuracy) {
  return accuracy == Accuracy::standard ? exp2(exponent * log2(x)) : pow(x, exponent);
}

class ContyKullaSheen final : public Lobe {
 public:
  /// All prepared; roughness in [lowest_roughness, 1].
  ContyKullaSheen(Float3 normal, Color3 color, Float roughness)
      : normal_(normal), color_(color), roughness_(roughness) {}

  std::string_view name() const override { return "sheen_bsdf"; }
  std::int32_t kinds() const override { return lobe_diffuse_reflection; }

  void prepare(const View& view, Bool mask) const override {
    terms_.prepare(view, mask, [&] { return compute(view); });
  }

  LobeValue evaluate(const View& view, Float3 wi) const override {
    const Terms terms = terms_.get(view, [&] { return compute(view); });
    const Float3 n = facing(normal_, view.wo);
    const Float cos_o = facing_cosine(normal_, view.wo);
    const Float cos_i = saturate(dot(wi, n));
    const Float3 h = view.wo + wi;
    const Float3 across = cross(n, h);
    const Float length2 = dot(h, h);
    // |n x h|^2 keeps the digits that 1 - (n.h)^2 loses near the normal.
    const Float sine2 = saturate(dot(across, across) / length2);
    const Float power = 1.0f / roughness_;
    const Float d = (2.0f + power) * raise(sine2, 0.5f * power, view.accuracy);
    const Float slope = cos_i / max(fma(-cos_i, cos_o, cos_i + cos_o), 1e-20f);
    const Bool seen = (cos_i > 0.0f) & (length2 > 1e-8f) & is_unit(wi);
    const Float f = d * slope * terms.scale * (0.125f * one_over_pi);
    return {.f = color_ * Float3(select(seen, finite(f), 0.0f)),
            .pdf = select((cos_i > 0.0f) & is_unit(wi), Float(0.5f * one_over_pi), 0.0f)};
  }

  /// Uniform over the hemisphere, as the authors do: the weight is at most
  /// (2 + 1 / r) / 4, where a cosine would make it unbounded at grazing angles.
  LobeSample sample(const View& view, Float3 u) const override {
    const Float z = 1.0f - u.x;
    const Float radius = safe_sqrt(u.x * (2.0f - u.x));
    const Float2 on = on_circle(u.y);
    const Frame frame = facing_frame(normal_, view.wo);
    const Float3 wi = frame.to_world({radius * on.x, radius * on.y, z});
    return {.wi = wi, .valid = true};
  }

  Color3 albedo(const View& view) const override {
    return saturate(color_ * Float3(terms_.get(view, [&] { return compute(view); }).albedo));
  }
  Color3 throughput(const View& view) const override {
    return Color3(1.0f - terms_.get(view, [&] { return compute(view); }).albedo);
  }
  Float3 normal(const View&) const override { return normal_; }
  Float roughness(const View&) const override { return roughness_; }

 private:
  struct Terms {
    Float albedo;  ///< Without the colour; in [0, 1].
    Float scale;   ///< In (0, 1].
    template <class F>
    friend void visit(Terms& terms, F&& f) {
      f(terms.albedo), f(terms.scale);
    }
  };
  Terms compute(const View& view) const {
    const Float x = sqrt(min(abs(dot(normal_, view.wo)), 1.0f));
    const Float all = polynomial(numerator, x, roughness_) / polynomial(denominator, x, roughness_);
    return {saturate(all), 1.0f / max(all, 1.0f)};
  }

  Float3 normal_;
  Color3 color_;
  Float roughness_;
  PerView<Terms> terms_;
};

/// Zeltner, Burley and Chiang, "Practical Multiple-Scattering Sheen Using Linearly
/// Transformed Cosines", SIGGRAPH 2022 talks: a cosine lobe bent by a matrix, which
/// is also how it is sampled, exactly. The matrix and the albedo are the rational
/// fits of MaterialX 1.39. Not reciprocal: the matrix belongs to the view.
class ZeltnerSheen final : public Lobe {
 public:
  /// All prepared; roughness in [0.01, 1], the range of the fits.
  ZeltnerSheen(Float3 normal, Color3 color, Float roughness)
      : normal_(normal), color_(color), roughness_(roughness) {}

  std::string_view name() const override { return "sheen_bsdf"; }
  std::int32_t kinds() const override { return lobe_diffuse_reflection; }

  void prepare(const View& view, Bool mask) const override {
    terms_.prepare(view, mask, [&] { return compute(view); });
  }

  LobeValue evaluate(const View& view, Float3 wi_world) const override {
    const Terms terms = terms_.get(view, [&] { return compute(view); });
    const Float3 wi = frame(view).to_local(wi_world);
    const Float3 w{fma(terms.a, wi.x, terms.b * wi.z), terms.a * wi.y, wi.z};
    const Float density = saturate(w.z) * one_over_pi * square(terms.a / dot(w, w));
    const Float pdf = select((wi.z > 0.0f) & is_unit(wi), finite(density), 0.0f);
    return {.f = color_ * Float3(terms.albedo * pdf), .pdf = pdf};
  }

  LobeSample sample(const View& view, Float3 u) const override {
    const Terms terms = terms_.get(view, [&] { return compute(view); });
    const Float3 w = sample_cosine(u.x, u.y);
    // Of the length that the inverse matrix would give times a: no division by it.
    const Float3 bent = normalize({fma(-terms.b, w.z, w.x), w.y, terms.a * w.z});
    const Float3 wi = frame(view).to_world(bent);
    return {.wi = wi, .valid = true};
  }

  Color3 albedo(const View& view) const override {
    return saturate(color_ * Float3(terms_.get(view, [&] { return compute(view); }).albedo));
  }
  Color3 throughput(const View& view) const override {
    return Color3(1.0f - terms_.get(view, [&] { return compute(view); }).albedo);
  }
  Float3 normal(const View&) const override { return normal_; }
  Float roughness(const View&) const override { return roughness_; }

 private:
  /// The inverse matrix is (a 0 b; 0 a 0; 0 0 1), its x axis along the view.
  struct Terms {
    Float a, b, albedo;
    template <class F>
    friend void visit(Terms& terms, F&& f) {
      f(terms.a), f(terms.b), f(terms.albedo);
    }
  };

  Frame frame(const View& view) const { return make_frame(facing(normal_, view.wo), view.wo); }

  Terms compute(const View& view) const {
    const Float x = min(abs(dot(normal_, view.wo)), 1.0f);
    const Float y = roughness_;
    const Float a =
        fma(2.58126f, x, 0.813703f * y) * y / fma(0.310327f * x, x, fma(2.60994f * x, y, 1.0f));
    const Float b = safe_sqrt(1.0f - x) * (y - 1.0f) * (y * y * y) /
                    fma(1.34174f * y, y, fma(x, fma(-1.71506f, y, 1.71228f), 0.0000254053f));
    return {a, b, fitted_albedo(x, y)};
  }

  static Float fitted_albedo(Float x, Float y) {
    const Float s = y * fma(1.58491f, y, 0.0206607f) / fma(y, 1.32227f + y, 0.0379424f);
    const Float m_inner = fma(y, fma(y, fma(y * y, -0.95943f, 1.7932f), -1.14885f), -0.193854f);
    const Float m = y * m_inner / (0.046391f + y);
    const Float o =
        y * fma(y, fma(0.119681f, y, -0.0207818f), 0.000654023f) / fma(y, y - 1.92021f, 1.26264f);
    constexpr float root_two_pi = 2.50662827f;
    return saturate(exp(-0.5f * square((x - m) / s)) / (s * root_two_pi) + o);
  }

  Float3 normal_;
  Color3 color_;
  Float roughness_;
  PerView<Terms> terms_;
};

}  // namespace

/// sheen_bsdf. MaterialX PBS 1.39, "sheen_bsdf". What it reflects of a layer below
/// is without the colour, as the library's 1.39.5 closures have it. A mode other
/// than "zeltner" is "conty_kulla", the default.
void record_closure_sheen_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const Float3 normal = prepare_facing_normal(recorder, call.vector3("normal"));
  const Color3 color = prepare_tint(recorder, call.vector3("color"));
  const Float roughness = call.number("roughness");
  LobePtr lobe;
  if (call.text("mode") == "zeltner") {
    lobe = std::make_shared<ZeltnerSheen>(normal, color,
                                          keep(recorder, clamp(roughness, 0.01f, 1.0f)));
  } else {
    lobe = std::make_shared<ContyKullaSheen>(
        normal, color, keep(recorder, clamp(roughness, lowest_roughness, 1.0f)));
  }
  set_lobe(call, std::move(lobe));
}

}  // namespace nacre
