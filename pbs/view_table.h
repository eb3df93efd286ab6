#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pbs/facets.h"
#include "pbs/view.h"

namespace nacre {

/// What a lobe works out for a view from above a surface whose normal is z and whose tangent is x.
using OfView = std::function<std::vector<Float>(const View& view)>;

/// The same as a table over those views, for one that `local` has: where numbers of the document
/// say all else, and the table is no further off than View::table_error in the middle of its cells.
/// Nothing where other things matter, where it would save little, and where
/// making it would take long. Recorded at top level. Views from below, which see another index,
/// get those numbers as well.
std::optional<std::vector<Float>> from_view_table(const View& view, const LocalView& local,
                                                  bool isotropic, const OfView& of_view);

/// The same of facets, for what a lobe works out as a structure with visit(). Made once for a view;
/// lives while one Program is recorded.
template <class T>
class ViewTable {
 public:
  /// `of_upright`: the structure of upright facets. Nothing where none is asked for, and but at top
  /// level.
  template <class F>
  std::optional<T> get(const View& view, const Facets& facets, F&& of_upright) const {
    if (view.table_error <= 0 || !view.recorder->at_top_level()) return std::nullopt;
    for (const Made& made : made_) {
      if (same_value(made.wo, view.wo)) return made.value;
    }
    const OfView of_view = [&](const View& seen) {
      std::vector<Float> all;
      T value = of_upright(seen);
      visit(value, [&](Float& scalar) { all.push_back(scalar); });
      return all;
    };
    std::optional<T> value;
    const LocalView local = facets.look(view);
    if (const auto found = from_view_table(view, local, facets.isotropic, of_view)) {
      std::size_t at = 0;
      visit(value.emplace(), [&](Float& scalar) { scalar = (*found)[at++]; });
    }
    made_.push_back({view.wo, value});
    return value;
  }

 private:
  struct Made {
    Float3 wo;
    std::optional<T> value;
  };
  mutable std::vector<Made> made_;
};

/// What is known from above; else, and from below where another index is seen, what is computed.
template <class T, class F>
T from_table_or(const View& view, const Facets& facets, const std::optional<T>& known,
                F&& compute) {
  return known ? if_any(facets.look(view).below, *known, compute) : compute();
}

}  // namespace nacre
