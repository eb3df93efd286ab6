#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nacre {

/// Numbers that never change once made, and a digest that stands for them.
class TableValues {
 public:
  /// Takes the numbers and computes the digest.
  explicit TableValues(std::vector<float> values);

  /// For ever the same.
  const std::vector<float>& values() const { return values_; }
  /// SHA-256 over the values, as 64 hexadecimal digits.
  const std::string& digest() const { return digest_; }

 private:
  std::vector<float> values_;
  std::string digest_;
};

/// A constant texture that a text declares, "uniform sampler3D NAME;", and reads by
/// texture(NAME, place). Places count from 0 to 1 over the texels, outside means the
/// edge, and between texel centres the numbers are linear along every axis (OpenGL 4.6
/// core profile, 8.14.2, clamp to edge).
struct TextTable {
  /// What a look-up between texel centres gives.
  enum class Filter : std::uint8_t { nearest, linear };

  std::string name;                          ///< Of the sampler in the text.
  std::array<std::size_t, 3> size{1, 1, 1};  ///< Texels along x, y, z; all at least 1.
  std::size_t channels = 3;                  ///< 1 to 4; what is missing reads as (0, 0, 0, 1).
  Filter filter = Filter::linear;            ///< Along all axes.
  /// The channels of a texel side by side, then x, y, z.
  std::shared_ptr<const TableValues> values;
};

/// Whether the sizes are in range and there are as many values as they ask for; no
/// more than 2^28.
bool is_whole(const TextTable& table);

}  // namespace nacre
