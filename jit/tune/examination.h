#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "jit/tune/recorded_points.h"
#include "jit/tune/trial.h"

namespace nacre {

/// Points, and what is right there.
struct Examination {
  TunePoints points;
  Columns exact;
  std::string about;  ///< Which points they are, for people.
};

/// With everything exact, in double precision. Null, with diagnostics, as TuneTrial::compile().
std::unique_ptr<TuneTrial> compile_exactly(const TuneSubject& subject, ShaderOptions options,
                                           Diagnostics& diagnostics);

/// Of `number` 0 or 1, which have no point in common: at `count` points of shading_points(), or,
/// where a renderer has shaded the material, at half of the points that it recorded, which may be
/// null. Nothing, with a diagnostic, where there is nothing to compare.
std::optional<Examination> examine(const TuneSubject& subject, const TuneTrial& exactly,
                                   std::size_t count, const RecordedPoints* recorded,
                                   std::uint32_t number, Diagnostics& diagnostics);

}  // namespace nacre
