#include "examples/render/sky_map.h"

#include <cassert>
#include <numbers>

namespace nacre::host {

namespace {

// Angles for where a direction is in an image need not be exact to the last bit, as the library's
// are; and whole blocks of them are made in lanes, which the library's are not.

constexpr float pi = std::numbers::pi_v<float>;

/// In [0, pi], for x in [-1, 1]: Abramowitz and Stegun 1964, 4.4.46, off by at most 2e-8 before
/// rounding.
[[gnu::always_inline]] inline float arc_cosine(float x) {
  const float a = std::min(std::abs(x), 1.f);
  float sum = -0.0012624911f;
  for (const float c : {0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f, 0.0889789874f,
                        -0.2145988016f, 1.5707963050f}) {
    sum = sum * a + c;
  }
  const float angle = std::sqrt(1.f - a) * sum;
  return x < 0.f ? pi - angle : angle;
}

/// In [-pi, pi]; 0 of zeros: Abramowitz and Stegun 1964, 4.4.49, off by at most 2e-8 before
/// rounding.
[[gnu::always_inline]] inline float arc_tangent(float y, float x) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float larger = std::max(ax, ay);
  const float ratio = std::min(ax, ay) / (larger > 0.f ? larger : 1.f), square = ratio * ratio;
  float sum = 0.0028662257f;
  for (const float c : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f,
                        -0.1420889944f, 0.1999355085f, -0.3333314528f, 1.f}) {
    sum = sum * square + c;
  }
  const float least = sum * ratio;
  const float of_half = ay > ax ? 0.5f * pi - least : least;
  const float angle = x < 0.f ? pi - of_half : of_half;
  return y < 0.f ? -angle : angle;
}

struct SineCosine {
  float sine, cosine;
};

/// Of 2 pi times a number of turns: the polynomials of Moshier's Cephes library 2.2 (sinf.c) for an
/// eighth of a turn to either side, which are right to about the last bit.
[[gnu::always_inline]] inline SineCosine sine_cosine(float turns) {
  const float whole = std::floor(4.f * turns + 0.5f);
  const float x = 2.f * pi * (turns - 0.25f * whole), square = x * x;
  const float s =
      x +
      x * square * ((-1.9515295891e-4f * square + 8.3321608736e-3f) * square - 1.6666654611e-1f);
  const float c = 1.f - 0.5f * square +
                  square * square *
                      ((2.443315711809948e-5f * square - 1.388731625493765e-3f) * square +
                       4.166664568298827e-2f);
  const int quarter = static_cast<int>(whole) & 3;
  const float a = (quarter & 1) != 0 ? c : s, b = (quarter & 1) != 0 ? s : c;
  return {(quarter & 2) != 0 ? -a : a, quarter == 1 || quarter == 2 ? -b : b};
}

/// A block, each number in an array of its own.
constexpr std::size_t block_size = SkyMap::block_size;
struct Block {
  std::size_t count;  ///< With some more, so that all are in whole lanes.
  alignas(64) float x[block_size], y[block_size], z[block_size];  ///< Directions.
  alignas(64) float column[block_size], row[block_size];          ///< In texels.
};
void begin(Block& b, std::size_t count) {
  constexpr std::size_t lanes = 8;
  b.count = (count + lanes - 1) / lanes * lanes;
  for (std::size_t i = count; i < b.count; ++i) {
    b.x[i] = b.y[i] = b.z[i] = b.column[i] = 0.f;
  }
}

/// What of the map the angles depend on.
struct Sizes {
  float width, height, turns;
};

[[gnu::always_inline]] inline float row_at(float cosine, float height) {
  return std::min(arc_cosine(cosine) / pi, 0x1.fffffep-1f) * height;
}

[[gnu::always_inline]] inline void find_positions(const Sizes& s, Block& b) {
  for (std::size_t i = 0; i < b.count; ++i) {
    const float u = 0.5f + arc_tangent(b.x[i], -b.z[i]) / (2.f * pi) - s.turns;
    b.column[i] = std::min(u - std::floor(u), 0x1.fffffep-1f) * s.width;
    b.row[i] = row_at(b.y[i], s.height);
  }
}

/// Of columns, and y of directions.
[[gnu::always_inline]] inline void find_directions(const Sizes& s, Block& b) {
  for (std::size_t i = 0; i < b.count; ++i) {
    const float y = b.y[i];
    const float radius = std::sqrt(std::max(0.f, 1.f - y * y));
    const SineCosine around = sine_cosine(b.column[i] / s.width - 0.5f + s.turns);
    b.x[i] = radius * around.sine;
    b.z[i] = -radius * around.cosine;
    b.row[i] = row_at(y, s.height);
  }
}

/// The same for whole blocks in as many lanes as the machine has.
struct Ways {
  void (*positions)(const Sizes&, Block&);
  void (*directions)(const Sizes&, Block&);
};

void positions_plain(const Sizes& s, Block& b) { find_positions(s, b); }
void directions_plain(const Sizes& s, Block& b) { find_directions(s, b); }

#ifdef __x86_64__
[[gnu::target("avx2")]] void positions_avx2(const Sizes& s, Block& b) { find_positions(s, b); }
[[gnu::target("avx2")]] void directions_avx2(const Sizes& s, Block& b) { find_directions(s, b); }
#endif

Ways fastest_ways() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return {positions_avx2, directions_avx2};
#endif
  return {positions_plain, directions_plain};
}

const Ways& ways() {
  static const Ways known = fastest_ways();
  return known;
}

}  // namespace

SkyMap::SkyMap(int width, int height, float rotation)
    : width_(static_cast<float>(width)),
      height_(static_cast<float>(height)),
      turns_(rotation / (2.f * pi) - std::floor(rotation / (2.f * pi))) {}

void SkyMap::positions_of(const Vec3* directions, std::size_t count, Vec2* positions) const {
  assert(count <= block_size);
  Block b;
  begin(b, count);
  for (std::size_t i = 0; i < count; ++i) {
    b.x[i] = directions[i].x;
    b.y[i] = directions[i].y;
    b.z[i] = directions[i].z;
  }
  ways().positions({width_, height_, turns_}, b);
  for (std::size_t i = 0; i < count; ++i) positions[i] = {b.column[i], b.row[i]};
}

void SkyMap::directions_to(const Place* places, std::size_t count, Vec3* directions,
                           Vec2* positions) const {
  assert(count <= block_size);
  Block b;
  begin(b, count);
  for (std::size_t i = 0; i < count; ++i) {
    b.column[i] = places[i].column;
    b.y[i] = places[i].height;
  }
  ways().directions({width_, height_, turns_}, b);
  for (std::size_t i = 0; i < count; ++i) {
    directions[i] = {b.x[i], b.y[i], b.z[i]};
    positions[i] = {b.column[i], b.row[i]};
  }
}

}  // namespace nacre::host
