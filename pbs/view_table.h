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
/// Nothing where it is not to be, where other things matter, where it would save little, and where
/// making it would take long. Recorded at top level. Views from below, which see another index,
/// get those numbers as well.
std::optional<std::vector<Float>> from_view_table(const View& view, const LocalView& local,
                                                  bool isotropic, const OfView& of_view);

/// The same of facets, for a structure with visit(), from upright ones.
template <class T, class F>
std::optional<T> view_table(const View& view, const Facets& facets, F&& of_upright) {
  const OfView of_view = [&](const View& seen) {
    std::vector<Float> all;
    T value = of_upright(seen);
    visit(value, [&](Float& scalar) { all.push_back(scalar); });
    return all;
  };
  const auto found = from_view_table(view, facets.look(view), facets.isotropic, of_view);
  if (!found) return std::nullopt;
  T value{};
  std::size_t at = 0;
  visit(value, [&](Float& scalar) { scalar = (*found)[at++]; });
  return value;
}

/// What is known from above; else, and from below where another index is seen, what is computed.
template <class T, class F>
T from_table_or(const View& view, const Facets& facets, const std::optional<T>& known,
                F&& compute) {
  return known ? if_any(facets.look(view).below, *known, compute) : compute();
}

}  // namespace nacre
