#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jit/tune/error.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Points of a material that a renderer has shaded.
struct PointsOfMaterial {
  std::string material;
  std::size_t count = 0;
  Columns floats;                                             ///< By channel, `count` of each.
  std::map<std::string, std::vector<std::int32_t>> integers;  ///< Truths too.
};

/// Those of all materials of a scene, as `nacre render --record-points` writes them: where errors
/// are measured that are to hold there. JSON:
///
///   {"nacre_points": 1,
///    "materials": [{"material": "Gold", "count": 4096,
///                   "channels": {"P.x": [...], ...}, "integers": {...}}]}
class RecordedPoints {
 public:
  /// Nothing, with a diagnostic, for what is no such file.
  static std::optional<RecordedPoints> parse(std::string_view text, const std::string& file,
                                             Diagnostics& diagnostics);

  bool is_empty() const { return materials_.empty(); }
  void add(PointsOfMaterial points) { materials_.push_back(std::move(points)); }
  /// Null where there are none.
  const PointsOfMaterial* find(std::string_view material) const;
  std::string text() const;

 private:
  std::vector<PointsOfMaterial> materials_;
};

}  // namespace nacre
