#pragma once

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nacre {

/// What the numbers of an input are, and so which of them are hostile.
enum class Meaning : std::uint8_t {
  share,        ///< Weights and mixtures, [0, 1].
  color,        ///< A component of reflected light, mostly [0, 1].
  alpha,        ///< Roughness, as alpha or as its root: 0, tiny, 1.
  index,        ///< Of refraction: near 1, below it, 40.
  extinction,   ///< 0 .. 1e4 and more.
  anisotropy,   ///< [-1, 1]
  film,         ///< Thickness in nm, or in micrometres.
  degrees,      ///< An angle or a share of a turn.
  length,       ///< A depth, radius or distance: 0 .. infinity.
  coefficient,  ///< Per length: 0 .. infinity.
  position,     ///< Any place; the origin, where points are, among them.
  direction,    ///< A component of what should be a unit vector.
  exponent,     ///< Of a power; 0 and negative ones too.
  radiance,     ///< 0 .. the largest float.
  any,          ///< All floats are alike.
};

/// An input that is the same all over a surface and decides what is recorded, as text.
using Setting = std::pair<std::string_view, std::string_view>;

/// A closure or shader that a nodedef declares. A row of the table is all that a new one needs.
struct ClosureCase {
  std::string_view nodedef;
  /// How it is compiled: each of these is kernels of its own.
  std::vector<std::vector<Setting>> forms = {{}};
  /// Inputs whose names say another thing than in other nodedefs (see meaning_of).
  std::vector<std::pair<std::string_view, Meaning>> meanings = {};
  bool large = false;  ///< Has several lobes: `make test` has fewer points of it.
};

/// Every nodedef of the data library and of pbs/library that gives a BSDF, EDF, VDF or shader.
std::span<const ClosureCase> closure_cases();

/// What an input of that name is in this row: as the row says, else by words in its name, else
/// `is_color` or not.
Meaning meaning_of(const ClosureCase& row, std::string_view input, bool is_color);

/// "dielectric_bsdf", for the names of tests.
std::string short_name(const ClosureCase& row);

inline void PrintTo(const ClosureCase& row, std::ostream* out) { *out << row.nodedef; }

}  // namespace nacre
