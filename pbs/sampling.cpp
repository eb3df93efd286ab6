#include "pbs/sampling.h"

#include <array>
#include <cstddef>

namespace nacre {

namespace {

// sin(2 pi x) / (x (1 - 4 x^2)) and cos(2 pi x) / (1 - 16 x^2) in powers of x^2: without the zeros
// within half a circle, at which nothing is lost then. Minimax by Remez's exchange for |x| up to
// 1/2; times what they lack off by 1.3e-9 and 1.2e-8.
constexpr std::array sine_series{6.2831853f,  -16.208956f, 16.769188f,
                                 -9.6245765f, 3.5162135f,  -0.79801972f};
constexpr std::array cosine_series{0.99999999f, -3.7392046f, 5.1118525f,
                                   -3.6607419f, 1.5979476f,  -0.40875758f};

Float sum_of(const std::array<float, 6>& series, Float x) {
  Float sum = series.back();
  for (std::size_t k = series.size() - 1; k-- > 0;) sum = fma(x, sum, series[k]);
  return sum;
}

}  // namespace

Float2 on_circle(Float share) {
  const Float x = share - round(share);  // Exact.
  const Float x2 = square(x);
  const Float sine = x * fma(x2, -4.0f, 1.0f) * sum_of(sine_series, x2);
  return {fma(x2, -16.0f, 1.0f) * sum_of(cosine_series, x2), sine};
}

Float2 sample_disk(Float u, Float v) {
  const Float radius = sqrt(u);
  const Float2 on = on_circle(v);
  return {radius * on.x, radius * on.y};
}

Float3 sample_cosine(Float u, Float v) {
  const Float2 p = sample_disk(u, v);
  return {p.x, p.y, safe_sqrt(1.0f - u)};
}

}  // namespace nacre
