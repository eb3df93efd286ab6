#include "jit/tune/examination.h"

#include <fmt/format.h>

#include <bit>
#include <set>
#include <utility>

#include "jit/tune/choices.h"

namespace nacre {

namespace {

/// Elements `first`, `first + 2`, and so on.
template <class T>
std::vector<float> every_second(const std::vector<T>& column, std::size_t first) {
  std::vector<float> half;
  for (std::size_t i = first; i < column.size(); i += 2)
    half.push_back(std::bit_cast<float>(column[i]));
  return half;
}

/// What is not recorded of the points that are, and so is as at points of no scene.
std::string missing_text(const TuneTrial& exactly, const Columns& recorded) {
  std::set<std::string> missing = exactly.point_channels();
  std::erase_if(missing, [&](const std::string& name) { return recorded.contains(name); });
  return missing.empty() ? "" : fmt::format(", but for {}", fmt::join(missing, ", "));
}

/// Points of a material, or null, with a warning where others are recorded.
const PointsOfMaterial* recorded_of(const TuneSubject& subject, const RecordedPoints* recorded,
                                    Diagnostics& diagnostics) {
  if (recorded == nullptr) return nullptr;
  const PointsOfMaterial* const found =
      subject.is_material ? recorded->find(subject.names.front()) : nullptr;
  // Half of one is none.
  if (found != nullptr && found->count >= 2) return found;
  diagnostics.warning("not-recorded", {.file = {}, .path = subject.text()},
                      "errors are measured at points of no scene",
                      subject.is_material ? "two recorded points of this material at least"
                                          : "a material, of which points are recorded",
                      found == nullptr ? "none" : "one");
  return nullptr;
}

}  // namespace

std::unique_ptr<TuneTrial> compile_exactly(const TuneSubject& subject, ShaderOptions options,
                                           Diagnostics& diagnostics) {
  apply_choices(exact_choices(), options);
  options.compile.backend = Backend::reference;
  options.compile.facts.clear();  // They change no number.
  options.compile.asynchronous = false;
  return TuneTrial::compile(subject, options, diagnostics);
}

std::optional<Examination> examine(const TuneSubject& subject, const TuneTrial& exactly,
                                   std::size_t count, const RecordedPoints* recorded,
                                   std::uint32_t number, Diagnostics& diagnostics) {
  Examination made;
  made.points.set = {.count = count, .number = number, .varied_footprints = true};
  Diagnostics once;
  const PointsOfMaterial* const own =
      recorded_of(subject, recorded, number == 0 ? diagnostics : once);
  if (own != nullptr) {
    made.points.set.count = (own->count + 1 - number) / 2;
    for (const auto& [name, column] : own->floats) {
      made.points.given[name] = every_second(column, number);
    }
    for (const auto& [name, column] : own->integers) {
      made.points.given[name] = every_second(column, number);
    }
    made.about = fmt::format("{} points that a renderer has recorded{}", made.points.set.count,
                             missing_text(exactly, made.points.given));
  } else {
    made.about = fmt::format(
        "{} points: P in [-4, 4]^3, uv in [0, 1]^2, viewer above the surface, light from "
        "anywhere, footprints of 2^-16 to 2^-6, other numbers in [0.05, 0.95]",
        count);
  }
  made.points.given.merge(exactly.directions(made.points));
  made.exact = exactly.results(made.points);
  if (!made.exact.empty()) return made;
  if (exactly.is_stopped()) return std::nullopt;
  diagnostics.error("not-tuned", {.file = {}, .path = subject.text()},
                    "there is nothing to compare", "results at every point",
                    "none, or a kernel that takes too many steps");
  return std::nullopt;
}

}  // namespace nacre
