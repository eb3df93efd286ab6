#include "pbs/thin_film.h"

#include <fmt/format.h>

#include <algorithm>
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

bool is_grey(Color3 x) { return same_value(x, Color3(x.x)); }

/// What a film does to light of one polarisation, by its two interfaces.
struct Interfaces {
  Float r12_s, r12_p;                ///< Real: 0 where the film is as what is before it.
  std::array<Amplitudes, 3> behind;  ///< By channel; of a grey substrate the first is all three.
  bool grey;
  const Amplitudes& of(std::size_t channel) const { return behind[grey ? 0 : channel]; }
};

Color3 by_orders(const Interfaces& film, Float path, int terms) {
  Spectrum spectrum(path);
  std::vector<std::array<Complex, 3>> means;  // By order.
  for (int m = 0; m < terms; ++m) {
    if (m > 0) spectrum.next_order();
    means.push_back({spectrum.mean(0), spectrum.mean(1), spectrum.mean(2)});
  }
  const auto channel = [&](std::size_t c) {
    Airy s(film.r12_s, film.of(c).s);
    Airy p(film.r12_p, film.of(c).p);
    for (const auto& mean : means) s.add(mean[c]), p.add(mean[c]);
    return 0.5f * (s.sum() + p.sum());
  };
  return {channel(0), channel(1), channel(2)};
}

/// Wave numbers at which Airy's formula is taken as it stands: equal steps of a quarter of the
/// narrowest sensitivity, out to four and a half deviations, where the trapezoidal rule is exact.
constexpr int wave_numbers = 64;
constexpr double first_wave_number = 1.18e-3, last_wave_number = 2.73e-3;  // In 1/nm.
constexpr double wave_number_step = (last_wave_number - first_wave_number) / (wave_numbers - 1);

/// How much each counts for a channel.
std::vector<float> wave_number_weights(int channel) {
  std::vector<double> weights(wave_numbers, 0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    const Gaussian& g = sensitivities()[k];
    std::vector<double> curve;
    double all = 0.0;
    for (int j = 0; j < wave_numbers; ++j) {
      const double offset = first_wave_number + j * wave_number_step - g.mean;
      curve.push_back(std::exp(-offset * offset / (4.0 * g.half_variance)));
      all += curve.back();
    }
    for (std::size_t j = 0; j < curve.size(); ++j) {
      weights[j] += to_rgb[channel][k] * g.weight * curve[j] / all;
    }
  }
  return {weights.begin(), weights.end()};
}

/// |(r12 + r23 t) / (1 + r12 r23 t)|^2: Born and Wolf, 1.6.4.
Float airy(Float r12, Complex r23, Complex turn) {
  const Complex x = r23 * turn;
  const Float above = fma(r12 + x.re, r12 + x.re, square(x.im));
  const Float re = fma(r12, x.re, 1.0f);
  const Float below = fma(re, re, square(r12 * x.im));
  return min(above / max(below, 1e-12f), 1.0f);
}

struct SpectralSum {
  Complex turn;
  Color3 light = Color3(0.0f);
};
template <class F>
void visit(SpectralSum& sum, F&& f) {
  f(sum.turn.re), f(sum.turn.im), visit(sum.light, f);
}

Color3 by_wave_numbers(Recorder& recorder, const Interfaces& film, Float path) {
  constexpr std::array names{"film.red", "film.green", "film.blue"};
  std::array<std::uint32_t, 3> tables{};
  for (std::size_t c = 0; c < 3; ++c) {
    tables[c] = recorder.table(names[c], wave_number_weights(static_cast<int>(c)));
  }
  const Float turns = 2.0f * 3.14159265f * path;
  const Float first = turns * Float(first_wave_number);
  const Float step = turns * Float(wave_number_step);
  const Complex on{cos(step), sin(step)};
  const SpectralSum start{.turn = {cos(first), sin(first)}};
  return loop(recorder, Bool(true), wave_numbers, start,
              [&](Int j, SpectralSum& sum) {
                const std::array<Ref, 1> index{j.ref()};
                std::array<Float, 3> light;
                Float reflected;
                for (std::size_t c = 0; c < 3; ++c) {
                  if (c == 0 || !film.grey) {
                    reflected = 0.5f * (airy(film.r12_s, film.of(c).s, sum.turn) +
                                        airy(film.r12_p, film.of(c).p, sum.turn));
                  }
                  light[c] = reflected * Float(recorder.emit(Op::table, index, tables[c]));
                }
                sum.light = sum.light + Color3(light[0], light[1], light[2]);
                sum.turn = sum.turn * on;
                return Bool(true);
              })
      .light;
}

/// Films of a longer path have no coherent light left beyond the orders that are summed.
constexpr float longest_spectral_path = 600.0f;

/// ThinFilm::reflectance, to so many orders.
Color3 film_reflectance(int terms, Float cosine, Float before, Float thickness, Float index,
                        Color3 n, Color3 k, Color3 bare) {
  const Float eta = index / before;
  const Float squared = 1.0f - max(1.0f - square(cosine), 0.0f) / square(eta);
  const Float inner = safe_sqrt(squared);
  const Float s_sum = fma(eta, inner, cosine);
  const Float p_sum = fma(eta, cosine, inner);
  const Float sine2 = max(1.0f - squared, 0.0f);
  const auto behind = [&](Float real, Float imaginary) {
    return amplitudes(inner, sine2, real / index, imaginary / index);
  };
  Interfaces film{.r12_s = (cosine - eta * inner) / max(s_sum, 1e-15f),
                  .r12_p = (eta * cosine - inner) / max(p_sum, 1e-15f),
                  .behind = {behind(n.x, k.x), {}, {}},
                  .grey = is_grey(n) && is_grey(k)};
  if (!film.grey) film.behind[1] = behind(n.y, k.y), film.behind[2] = behind(n.z, k.z);

  const Float path = 2.0f * index * inner * thickness;
  Recorder* recorder = path.ref().recorder;
  Color3 light;
  if (terms < ThinFilm::precise_terms || recorder == nullptr) {
    light = by_orders(film, path, terms);
  } else {
    const Bool is_short = path < longest_spectral_path;
    light = if_any(!is_short, Color3(0.0f), [&] { return by_orders(film, path, terms); });
    light = if_any(is_short, light, [&] { return by_wave_numbers(*recorder, film, path); });
  }
  const Float x = saturate(thickness * Float(1.0f / 30.0f));
  const Float presence = square(x) * fma(-2.0f, x, 3.0f);
  const auto channel = [&](Float found, Float without) {
    return saturate(lerp(without, select(squared > 0.0f, saturate(found), 1.0f), presence));
  };
  return {channel(light.x, bare.x), channel(light.y, bare.y), channel(light.z, bare.z)};
}

}  // namespace

ThinFilm::ThinFilm(Float thickness, Float index, Accuracy accuracy)
    : thickness_(clamp(thickness, 0.0f, 1e6f)),
      index_(clamp(index, 1.0f, 50.0f)),
      terms_(accuracy == Accuracy::fast       ? 2
             : accuracy == Accuracy::standard ? 3
                                              : precise_terms) {}

ThinFilm ThinFilm::in_sums() const {
  ThinFilm film = *this;
  film.terms_ = std::min(film.terms_, most_terms_in_sums);
  return film;
}

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
