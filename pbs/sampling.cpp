#include "pbs/sampling.h"

#include <array>
#include <cstddef>

namespace nacre {

namespace {

// Taylor's series of the sine, over x, and of the cosine of pi / 2 x, in powers of x^2. Up to
// |x| = 1/2 what follows is below 2e-9 and 3e-8.
constexpr std::array sine_series{1.5707963f, -0.64596410f, 7.9692626e-2f, -4.6817541e-3f,
                                 1.6044118e-4f};
constexpr std::array cosine_series{1.0f, -1.2337006f, 0.25366951f, -2.0863481e-2f, 9.1926027e-4f};

Float sum_of(const std::array<float, 5>& series, Float x) {
  Float sum = series.back();
  for (std::size_t k = series.size() - 1; k-- > 0;) sum = fma(x, sum, series[k]);
  return sum;
}

}  // namespace

Float2 on_circle(Float share) {
  // Whole quarters of the circle and what is left of one, which is exact.
  const Float quarters = 4.0f * share;
  const Float whole = round(quarters);
  const Float x = quarters - whole;
  const Float sine = x * sum_of(sine_series, square(x));
  const Float cosine = sum_of(cosine_series, square(x));
  const Int turns = to_int(whole);
  const Bool is_even = (turns & Int(1)) == Int(0);
  const auto turned = [](Float value, Int by) {
    return select((by & Int(2)) == Int(0), value, -value);
  };
  return {turned(select(is_even, cosine, sine), turns + Int(1)),
          turned(select(is_even, sine, cosine), turns)};
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
