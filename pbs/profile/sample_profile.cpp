#include "pbs/profile/sample_profile.h"

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <utility>

#include "pbs/root.h"
#include "pbs/sampling.h"

namespace nacre {

namespace {

constexpr float degree = pi / 180.0f;

using Values = std::function<Float(Int index)>;

/// The last of numbers that do not decrease, but of the very last, that is not above `wanted`; the
/// first one is not.
Int find_last(const Values& at, std::size_t count, Float wanted) {
  const auto most = static_cast<std::uint32_t>(count - 2);
  Int found = 0;
  for (std::uint32_t step = std::bit_floor(most); step > 0; step /= 2) {
    const Int next = found + Int(static_cast<std::int32_t>(step));
    const Bool fits = (next <= Int(static_cast<std::int32_t>(most))) & (at(next) <= wanted);
    found = select(fits, next, found);
  }
  return found;
}

/// A place between two angles of a table.
struct Place {
  Int first;
  Float fraction;
};

class ProfileSampler {
 public:
  ProfileSampler(Recorder& recorder, LightProfile::Type type, const ProfileTables& tables)
      : recorder_(recorder),
        type_(type),
        tables_(tables),
        rows_(static_cast<std::int32_t>(tables.vertical.size())) {}

  /// Vertical and horizontal angle, in radians.
  Float2 angles(Float2 u) const {
    const bool is_ring = tables_.horizontal.size() == 1;
    const Place h = is_ring ? Place{0, 0.0f} : horizontal(u.x);
    // Between two columns of a table: what is linear stays so.
    const auto between = [&](std::uint32_t table, Int row) {
      const Float near = at(table, h.first * rows_ + row);
      if (is_ring) return near;
      return lerp(near, at(table, (h.first + Int(1)) * rows_ + row), h.fraction);
    };
    const std::uint32_t below = table("below", tables_.below);
    const std::uint32_t intensity = table("intensity", tables_.intensity);
    const std::uint32_t vertical = table("sampled_vertical", tables_.vertical);
    const Values cumulative = [&](Int row) { return between(below, row); };
    const Float wanted = u.y * cumulative(rows_ - Int(1));
    const Int row = find_last(cumulative, tables_.vertical.size(), wanted);
    const Float share = share_within(cumulative(row), cumulative(row + Int(1)), wanted);
    const Segment segment{at(vertical, row), at(vertical, row + Int(1)), between(intensity, row),
                          between(intensity, row + Int(1))};
    const Float v = segment.invert(
        recorder_, share, [&](Float angle) { return vertical_weight(type_, angle * degree); });
    const Float around = is_ring ? u.x * 360.0f : horizontal_angle(h);
    return {lerp(segment.from, segment.to, v) * degree, around * degree};
  }

 private:
  /// Between two angles: a density that is linear, times a weight.
  struct Segment {
    Float from, to, first, last;

    /// The fraction below which is `share` of it.
    template <class Weight>
    Float invert(Recorder& recorder, Float share, Weight&& weight) const {
      const auto density = [&](Float t) {
        return lerp(first, last, t) * weight(lerp(from, to, t));
      };
      // Gauss-Legendre, three points (Abramowitz and Stegun, table 25.4): over 10 degrees within
      // 2e-7 of the segment's all. Two would be within 4e-4.
      const auto below = [&](Float t) {
        constexpr float near = 0.112701665f, far = 0.887298335f;
        const Float outer = density(near * t) + density(far * t);
        return t * fma(4.0f / 9.0f, density(0.5f * t), 5.0f / 18.0f * outer);
      };
      const Float wanted = share * below(1.0f);
      const Float start = invert_linear(density(0.0f), density(1.0f), share);
      return find_root(recorder, 0.0f, 1.0f, start,
                       [&](Float t) { return std::pair(below(t) - wanted, density(t)); });
    }
  };

  static Float share_within(Float from, Float to, Float wanted) {
    return saturate((wanted - from) / (to - from));
  }

  Place horizontal(Float u) const {
    const std::uint32_t before = table("before", tables_.before);
    const std::uint32_t below = table("below", tables_.below);
    const std::size_t count = tables_.horizontal.size();
    const Float wanted = u * tables_.before.back();
    const Values cumulative = [&](Int column) { return at(before, column); };
    const Int column = find_last(cumulative, count, wanted);
    const Float share = share_within(cumulative(column), cumulative(column + Int(1)), wanted);
    const auto all = [&](Int of) { return at(below, of * rows_ + rows_ - Int(1)); };
    const Float first = all(column), last = all(column + Int(1));
    if (type_ == LightProfile::Type::c) return {column, invert_linear(first, last, share)};
    const std::uint32_t horizontal = table("sampled_horizontal", tables_.horizontal);
    const Segment segment{at(horizontal, column), at(horizontal, column + Int(1)), first, last};
    return {column, segment.invert(recorder_, share, [&](Float angle) {
              return horizontal_weight(type_, angle * degree);
            })};
  }

  Float horizontal_angle(const Place& place) const {
    const std::uint32_t horizontal = table("sampled_horizontal", tables_.horizontal);
    return lerp(at(horizontal, place.first), at(horizontal, place.first + Int(1)), place.fraction);
  }

  std::uint32_t table(const char* name, const std::vector<float>& values) const {
    return recorder_.table(std::string("profile.") + name, values);
  }
  Float at(std::uint32_t table, Int index) const {
    const std::array<Ref, 1> operand{index.ref()};
    return Float(recorder_.emit(Op::table, operand, table));
  }

  Recorder& recorder_;
  const LightProfile::Type type_;
  const ProfileTables& tables_;
  const Int rows_;
};

Float3 direction_of(LightProfile::Type type, Float vertical, Float horizontal) {
  const Float sin_v = sin(vertical), cos_v = cos(vertical);
  const Float sin_h = sin(horizontal), cos_h = cos(horizontal);
  switch (type) {
    case LightProfile::Type::c: return {sin_v * cos_h, sin_v * sin_h, cos_v};
    case LightProfile::Type::b: return {sin_h, cos_h * sin_v, cos_h * cos_v};
    default: return {cos_v * sin_h, sin_v, cos_v * cos_h};
  }
}

}  // namespace

Float3 sample_profile(Recorder& recorder, const LightProfile& profile, const ProfileTables& tables,
                      Float3 u) {
  const Float2 angles = ProfileSampler(recorder, profile.type, tables).angles({u.x, u.y});
  Float3 w = direction_of(profile.type, angles.x, angles.y);
  const Mirrors mirrors = mirrors_of(profile);
  Float side = u.z;
  const auto mirrored = [&](Float x) {
    const Bool other = side >= 0.5f;
    side = 2.0f * side - to_float(other);
    return select(other, -x, x);
  };
  if (mirrors.x) w.x = mirrored(w.x);
  if (mirrors.y) w.y = mirrored(w.y);
  return w;
}

Float profile_weight(LightProfile::Type type, Float3 w) {
  const Float along = abs(w.z);
  if (type == LightProfile::Type::c) return along + least_cosine;
  const Float side = type == LightProfile::Type::b ? w.y : w.x;
  const Float latitude = sqrt(fma(side, side, square(w.z)));
  const Float longitude = select(latitude > 0.0f, min(along / latitude, 1.0f), 1.0f);
  return (latitude + least_cosine) * (longitude + least_cosine);
}

}  // namespace nacre
