#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/diagnostic.h"
#include "runtime/near_names.h"

namespace nacre {

/// Which of the names that there are somebody will have meant by one that there is not: those
/// that differ in case only, or else those that few slips of the fingers lead to. A slip is a
/// letter too many, missing, wrong, or changed for its neighbour (optimal string alignment:
/// Damerau, "A technique for computer detection and correction of spelling errors", 1964), upper
/// and lower case being one. One slip is near for a name of three letters, two for six, three for
/// nine or more; shorter names have nothing near but their other case.
class NearNames {
 public:
  static constexpr std::size_t most_given = 3;
  /// A hint is not worth more: of longer lists the first count.
  static constexpr std::size_t most_offered = 10'000;

  explicit NearNames(std::string_view wanted);

  /// One of the names that there are. What is offered twice counts once.
  void offer(std::string_view known);

  /// The nearest ones, those that as few slips lead to, at most `most_given`, by name.
  std::vector<std::string> names() const;

  /// For Diagnostic::hint: "it differs only in case from 'Mix'", "did you mean 'mix' or 'min'?";
  /// "" where nothing is near. `before` stands before each name.
  std::string hint(std::string_view before = {}) const;

 private:
  struct Near {
    std::size_t slips;
    std::string name;
    auto operator<=>(const Near&) const = default;
  };

  std::string wanted_;
  std::size_t most_slips_;
  std::size_t offered_ = 0;
  std::vector<Near> near_;  ///< Sorted.
};

/// NearNames::hint of a range, each of which has the name that `name_of` says, "" for none. Nothing
/// where so much was said already that nobody reads it: a document of nothing but faults takes no
/// time for hints.
template <class Range, class NameOf = std::identity>
std::string near_hint(const Diagnostics& said, std::string_view wanted, const Range& known,
                      NameOf name_of = {}) {
  constexpr std::size_t most_hints = 100;
  if (said.all().size() >= most_hints) return {};
  NearNames near(wanted);
  for (const auto& each : known) near.offer(name_of(each));
  return near.hint();
}

}  // namespace nacre
