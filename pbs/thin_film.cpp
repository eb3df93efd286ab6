#include "pbs/thin_film.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "pbs/per_view.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

constexpr float tiny = 1e-30f;

struct Complex {
  Float re, im;
};
Complex operator*(Complex a, Complex b) {
  return {fma(a.re, b.re, -(a.im * b.im)), fma(a.re, b.im, a.im * b.re)};
}
Complex operator*(Complex a, Float s) { return {a.re * s, a.im * s}; }
Float norm(Complex a) { return fma(a.re, a.re, square(a.im)); }

/// The CIE 1931 sensitivities as Gaussians over the wave number in 1/nm: weight,
/// mean, and half the variance. Belcour and Barla 2017, supplemental code; weights
/// from its amplitudes, those of one curve together made 1.
struct Gaussian {
  double weight, mean, half_variance;
};
const std::array<Gaussian, 4>& sensitivities() {
  static const std::array<Gaussian, 4> curves = [] {
    std::array<Gaussian, 4> g{{{5.4856e-13, 1.6810e-3, 4.3278e-9},
                               {9.7470e-14, 2.2399e-3, 4.5282e-9},
                               {1.0, 1.7953e-3, 9.3046e-9},
                               {1.0, 2.2084e-3, 6.6121e-9}}};
    const double x0 = g[0].weight * std::sqrt(g[0].half_variance);
    const double x1 = g[1].weight * std::sqrt(g[1].half_variance);
    g[0].weight = x0 / (x0 + x1);
    g[1].weight = x1 / (x0 + x1);
    return g;
  }();
  return curves;
}

/// XYZ under equal-energy light to RGB with CIE 1931 primaries, as there; the
/// columns in the order of the Gaussians. Rows give 1 for white.
constexpr double to_rgb[3][4] = {{2.3706743, 2.3706743, -0.9000405, -0.4706338},
                                 {-0.5138850, -0.5138850, 1.4253036, 0.0885814},
                                 {0.0052982, 0.0052982, -0.0146949, 1.0093968}};

/// Mean over the sensitivity of each channel of exp(i phase), phase = 2 pi path /
/// wavelength, and of its powers.
class Spectrum {
 public:
  explicit Spectrum(Float path) {
    const Float turns = 2.0f * 3.14159265f * path;
    for (std::size_t k = 0; k < 4; ++k) {
      const Gaussian& g = sensitivities()[k];
      const Float angle = turns * Float(g.mean);
      const Float fade = exp(-square(turns) * Float(g.half_variance));
      rotation_[k] = {cos(angle), sin(angle)};
      fade_[k] = fade;
      power_[k] = rotation_[k];
      power_fade_[k] = fade;
    }
  }

  Complex mean(int channel) const {
    Complex sum{0.0f, 0.0f};
    for (std::size_t k = 0; k < 4; ++k) {
      const double share = to_rgb[channel][k] * sensitivities()[k].weight;
      const Float amount = Float(share) * power_fade_[k];
      sum = {fma(amount, power_[k].re, sum.re), fma(amount, power_[k].im, sum.im)};
    }
    return sum;
  }

  /// From order m to m + 1: the phase adds up, the fading goes as m^2.
  void next_order() {
    for (std::size_t k = 0; k < 4; ++k) {
      power_[k] = power_[k] * rotation_[k];
      fade_step_[k] = order_ == 1 ? fade_[k] * square(fade_[k]) : fade_step_[k] * square(fade_[k]);
      power_fade_[k] = power_fade_[k] * fade_step_[k];
    }
    ++order_;
  }

 private:
  int order_ = 1;
  std::array<Complex, 4> rotation_, power_;
  std::array<Float, 4> fade_, fade_step_, power_fade_;
};

/// Amplitudes reflected at an interface to complex index N, p and s.
struct Amplitudes {
  Complex s, p;
};

/// N = n + ik relative to the medium before. The wave behind has the component
/// a + ib = sqrt(N^2 - sin^2) along the normal.
Amplitudes amplitudes(Float cosine, Float sine2, Float n, Float k) {
  const Float re = (n - k) * (n + k);
  const Float im = 2.0f * n * k;
  const Float t = re - sine2;
  const Float greater = sqrt(0.5f * (sqrt(fma(t, t, square(im))) + abs(t)));
  const Float smaller = 0.5f * im / max(greater, tiny);
  const Bool mostly_real = t > 0.0f;
  const Float a = select(mostly_real, greater, smaller);
  const Float b = select(mostly_real, smaller, greater);
  const Float length2 = fma(a, a, square(b));

  const Float s_scale = 1.0f / max(fma(a + cosine, a + cosine, square(b)), tiny);
  const Complex s{(square(cosine) - length2) * s_scale, -2.0f * cosine * b * s_scale};
  const Float front = square(cosine) * fma(re, re, square(im));
  const Float p_re = fma(re, cosine, a);
  const Float p_im = fma(im, cosine, b);
  const Float p_scale = 1.0f / max(fma(p_re, p_re, square(p_im)), tiny);
  const Complex p{(front - length2) * p_scale, 2.0f * cosine * fma(im, a, -(re * b)) * p_scale};
  return {s, p};
}

/// Airy's sum for one polarisation and channel: r12 real, r23 complex.
class Airy {
 public:
  Airy(Float r12, Complex r23) : product_(r23 * -r12), power_(product_) {
    const Float r = square(r12);
    const Float r_behind = min(norm(r23), 1.0f);
    passed_ = max(1.0f - r, 0.0f);
    // Both interfaces perfect: nothing gets in.
    const Float through = square(passed_) * r_behind / max(1.0f - r * r_behind, 1e-7f);
    sum_ = r + through;
    amplitude_ = 2.0f * (through - passed_);
  }
  void add(Complex mean) {
    sum_ = fma(amplitude_, fma(power_.re, mean.re, -(power_.im * mean.im)), sum_);
    power_ = power_ * product_;
  }
  Float sum() const { return sum_; }

 private:
  Complex product_, power_;
  Float passed_, sum_, amplitude_;
};

/// ThinFilm::reflectance, to so many orders.
Color3 film_reflectance(int terms, Float cosine, Float before, Float thickness, Float index,
                        Color3 n, Color3 k, Color3 bare) {
  const Float eta = index / before;
  const Float squared = 1.0f - max(1.0f - square(cosine), 0.0f) / square(eta);
  const Float inner = safe_sqrt(squared);
  // First interface: real amplitudes, 0 where the film is as what is before it.
  const Float s_sum = fma(eta, inner, cosine);
  const Float p_sum = fma(eta, cosine, inner);
  const Float r12_s = (cosine - eta * inner) / max(s_sum, 1e-15f);
  const Float r12_p = (eta * cosine - inner) / max(p_sum, 1e-15f);

  Spectrum spectrum(2.0f * index * inner * thickness);
  std::vector<std::array<Complex, 3>> means;  // By order.
  for (int m = 0; m < terms; ++m) {
    if (m > 0) spectrum.next_order();
    means.push_back({spectrum.mean(0), spectrum.mean(1), spectrum.mean(2)});
  }
  const Float x = saturate(thickness * Float(1.0f / 30.0f));
  const Float presence = square(x) * fma(-2.0f, x, 3.0f);
  const Float sine2 = max(1.0f - squared, 0.0f);
  const auto channel = [&](std::size_t c, Float real, Float imaginary, Float without) {
    const Amplitudes behind = amplitudes(inner, sine2, real / index, imaginary / index);
    Airy s(r12_s, behind.s);
    Airy p(r12_p, behind.p);
    for (const auto& mean : means) s.add(mean[c]), p.add(mean[c]);
    const Float film = saturate(0.5f * (s.sum() + p.sum()));
    return saturate(lerp(without, select(squared > 0.0f, film, 1.0f), presence));
  };
  return {channel(0, n.x, k.x, bare.x), channel(1, n.y, k.y, bare.y), channel(2, n.z, k.z, bare.z)};
}

bool is_grey(Color3 x) { return same_value(x, Color3(x.x)); }

}  // namespace

ThinFilm::ThinFilm(Float thickness, Float index, Accuracy accuracy)
    : thickness_(clamp(thickness, 0.0f, 1e6f)),
      index_(clamp(index, 1.0f, 50.0f)),
      terms_(accuracy == Accuracy::fast       ? 2
             : accuracy == Accuracy::standard ? 3
                                              : 10) {}

Color3 ThinFilm::reflectance(Float cosine, Float before, Color3 n, Color3 k, Color3 bare) const {
  Recorder* recorder = cosine.ref().recorder;
  if (recorder == nullptr) {
    return film_reflectance(terms_, cosine, before, thickness_, index_, n, k, bare);
  }
  // Several hundred operations, and a surface asks for several angles.
  const std::string name = fmt::format("film_{}", terms_);
  const auto grey = [terms = terms_](Float c, Float v, Float d, Float i, Float real,
                                     Float imaginary, Float without) {
    return film_reflectance(terms, c, v, d, i, real, imaginary, without);
  };
  const auto coloured = [terms = terms_](Float c, Float v, Float d, Float i, Color3 real,
                                         Color3 imaginary, Color3 without) {
    return film_reflectance(terms, c, v, d, i, real, imaginary, without);
  };
  return if_any(thickness_ > 0.0f, bare, [&] {
    if (is_grey(n) && is_grey(k) && is_grey(bare)) {
      return outline<Color3>(*recorder, "grey_" + name, grey, cosine, before, thickness_, index_,
                             n.x, k.x, bare.x);
    }
    return outline<Color3>(*recorder, name, coloured, cosine, before, thickness_, index_, n, k,
                           bare);
  });
}

}  // namespace nacre
