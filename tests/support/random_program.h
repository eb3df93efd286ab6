#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/kernel.h"
#include "runtime/program/program.h"

namespace nacre {

/// What random_program() puts into a Program.
struct RandomProgramOptions {
  int operations = 40;  ///< At top level; regions and functions add more.
  int functions = 2;    ///< Outlined ones, at most.
  bool regions = true;
  bool memory = true;  ///< Tables, texels and texture calls.
};

/// A well-typed Program over all operations that engines run (none of the
/// transcendental functions, keep or ddx): a graph in which inputs, uniform
/// values, constants at the edges of their types, regions in regions, loops and
/// calls mix. The same seed always gives the same Program.
Program random_program(std::uint64_t seed, const RandomProgramOptions& options = {});

/// The part of a Program that computes one of its values at top level.
Program program_of_value(const Program& program, ValueId value);
/// The values that program_of_value() takes, in order: those before the first store.
std::vector<ValueId> top_level_values(const Program& program);

/// Bits of a float or integer: a third from the edges of their types, a third
/// any, a third of everyday size.
std::uint32_t hostile_bits(std::uint64_t seed);

/// Everything to run a Program on, decided by the seed and by the names of the
/// channels: so a part of a Program gets what the whole had.
class RandomBatch {
 public:
  /// Data for points 0 ... points - 1; the entries of `order` say which point
  /// stands where in the arrays.
  RandomBatch(const Program& program, std::uint64_t seed, const std::vector<std::uint32_t>& order);

  /// Runs `count` points from `start` on; by output, by point. Empty if the
  /// kernel wrote beyond the points it was to compute.
  std::vector<std::vector<std::uint32_t>> run(const Kernel& kernel, std::size_t start,
                                              std::size_t count) const;

 private:
  std::vector<std::vector<std::uint32_t>> inputs_;
  std::vector<std::uint32_t> parameters_;
  std::vector<std::vector<std::uint32_t>> words_;
  std::vector<TextureBinding> textures_;
};

}  // namespace nacre
