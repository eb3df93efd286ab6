#pragma once

#include <cstddef>
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
  bool operator==(const Fact&) const = default;
};

/// "texcoord.x in [0, 1]".
std::string to_string(const Fact& fact);

/// What of a fact is used: what kernels have less for it, of instructions.
struct FactUse {
  Fact fact;
  std::size_t saved = 0;
};

/// Whether they can be read; an error for each that cannot.
bool check_facts(std::span<const Fact> facts, Diagnostics& diagnostics);

/// Those that say something of what a Program reads.
std::vector<Fact> facts_of(std::span<const Fact> facts, const Program& program);

/// What they say.
Known known_by(std::span<const Fact> facts, const Program& program);

/// The output channel of with_check().
inline constexpr const char* outside_facts_channel = "outside_facts";

/// The Program with one output more, an i32: 0 of points of which all the facts hold.
Program with_check(const Program& program, std::span<const Fact> facts, std::size_t most);

}  // namespace nacre
