#include "jit/tune/points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "runtime/channel/channel_name.h"

namespace nacre {

namespace {

using Vector = std::array<float, 3>;

/// Numbers in [0, 1) that depend on the name and the set alone.
class Numbers {
 public:
  Numbers(std::string_view name, std::uint32_t set) : generator_(seed(name) + set) {}
  float next(float low = 0.0f, float high = 1.0f) {
    return low + (high - low) * static_cast<float>(generator_() >> 8) * 0x1p-24f;
  }

 private:
  static std::uint32_t seed(std::string_view name) {
    std::uint32_t hash = 2166136261u;  // FNV-1a.
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    return hash;
  }
  std::mt19937 generator_;
};

/// Unit, above the plane z = 0.
Vector above(Numbers& numbers) {
  const float z = numbers.next(0.05f, 1.0f);
  const float phi = 2.0f * std::numbers::pi_v<float> * numbers.next();
  const float ring = std::sqrt(1.0f - z * z);
  return {ring * std::cos(phi), ring * std::sin(phi), z};
}

/// A tangent in the plane z = 0.
Vector along(Numbers& numbers) {
  const float phi = 2.0f * std::numbers::pi_v<float> * numbers.next();
  return {std::cos(phi), std::sin(phi), 0.0f};
}

/// Component `i` of how a channel changes along an axis of the footprint, at the next point. Both
/// axes are drawn from equal sequences.
std::function<float()> footprint(int axis, std::size_t i, bool is_varied, Numbers& numbers) {
  const bool is_y = axis == 1;
  if (!is_varied) return [i, is_y] { return (i == 1) == is_y && i < 2 ? 0x1p-10f : 0.0f; };
  return [i, is_y, &numbers] {
    const float length = std::exp2(numbers.next(-11, -6));
    const float width = length * std::exp2(-numbers.next(0, 5));
    const Vector along_it = along(numbers);
    if (i > 1) return 0.0f;
    if (!is_y) return length * along_it[i];
    return width * (i == 0 ? -along_it[1] : along_it[0]);
  };
}

/// Component `i` of the group at the next point.
std::function<float()> group(std::string_view name, std::size_t i, Numbers& numbers) {
  if (name == "N" || name == "No" || name == "Ng") return [i] { return i == 2 ? 1.0f : 0.0f; };
  if (name == "wo" || name == "wi") return [&numbers, i] { return above(numbers)[i]; };
  if (name == "T" || name == "To") return [&numbers, i] { return along(numbers)[i]; };
  if (name == "B" || name == "Bo") {
    return [&numbers, i] {
      const Vector t = along(numbers);
      return std::array{-t[1], t[0], 0.0f}[i];
    };
  }
  if (name == "P" || name == "Po") {
    return [&numbers, i] {
      const Vector p{numbers.next(-4, 4), numbers.next(-4, 4), numbers.next(-4, 4)};
      return p[i];
    };
  }
  if (name.starts_with("uv")) {
    return [&numbers, i] {
      const std::array uv{numbers.next(), numbers.next(), 0.0f};
      return uv[i];
    };
  }
  return {};
}

}  // namespace

std::vector<float> shading_points(const Channel& channel, const PointSet& points) {
  const ChannelName name = parse_channel(channel.name);
  const auto component = static_cast<std::size_t>(std::max(name.component, 0));
  const std::optional<DerivativeName> derivative = parse_derivative(name.group);
  const bool is_of_frame = name.group == "B" || name.group == "Bo" || name.group == "To";
  // All components of a group from one sequence, the frame's three vectors from one too.
  Numbers whole(derivative ? derivative->group : is_of_frame ? "T" : name.group, points.number);
  Numbers own(channel.name, points.number);
  auto next = derivative ? footprint(derivative->axis, component, points.varied_footprints, whole)
                         : group(name.group, component, whole);
  if (!next) next = [&own] { return own.next(0.05f, 0.95f); };
  std::vector<float> values(points.count);
  for (float& value : values) {
    value = next();
    if (channel.type == Scalar::i32) value = std::bit_cast<float>(std::int32_t(16.0f * value));
    if (channel.type == Scalar::b1) value = std::bit_cast<float>(std::int32_t(value > 0.5f));
  }
  return values;
}

}  // namespace nacre
