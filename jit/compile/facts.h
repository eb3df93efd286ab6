#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jit/passes/range.h"
#include "runtime/diagnostic.h"
#include "runtime/program/program.h"

namespace nacre {

/// What a host says of numbers that kernels read, so that these leave out what cannot happen.
/// Where it is not so, kernels find that out and compute as if nothing had been said.
struct Fact {
  /// A channel, "texcoord.x", or all of a group, "texcoord"; a live parameter, "SR_gold/coat", or
  /// one number of it; or the scalar product of two groups, "dot(N,wo)".
  std::string name;
  double low = 0.0;   ///< None is less.
  double high = 0.0;  ///< None is more, and none is NaN.
  /// It holds wherever those of parameters do, as what is stored of these: nobody looks.
  bool is_implied = false;
  bool operator==(const Fact&) const = default;
};

/// "texcoord.x in [0, 1]".
std::string to_string(const Fact& fact);

/// How many instructions kernels have less for a fact, beside what all the others leave out and
/// without what it implies; 0 where that is less than to look whether it is so. Nothing is known of
/// code that was in the cache, nor, of parameters, where there are too many to try each.
struct FactUse {
  Fact fact;
  std::optional<std::size_t> saved;
};

/// Whether they can be read; an error for each that cannot.
bool check_facts(std::span<const Fact> facts, Diagnostics& diagnostics);

/// Says of each that none of the Programs reads, nor could read of other points, that it is of
/// nothing: a warning.
void warn_of_unread(std::span<const Fact> facts, std::span<const Program> programs,
                    Diagnostics& diagnostics);

/// What they say of what a Program reads: a fact for each channel or slot.
std::vector<Fact> facts_of(std::span<const Fact> facts, const Program& program);
/// Whether facts_of() has made one of the other.
bool is_part_of(const Fact& part, const Fact& whole);
/// What it takes for each point to look whether such a part is so, in additions.
double cost_of_check(const Fact& part, const Program& program);

/// Those of slots of its parameter block.
std::vector<Fact> facts_of_parameters(std::span<const Fact> facts, const Program& program);

/// What they say of a Program that is to be so exact.
Known known_by(std::span<const Fact> facts, const Program& program, Accuracy accuracy);

/// The output channel of with_check().
inline constexpr const char* outside_facts_channel = "outside_facts";

/// The Program with one output more, an i32: 0 of points of which all the facts hold.
Program with_check(const Program& program, std::span<const Fact> facts, std::size_t most);

}  // namespace nacre
