#pragma once

#include <functional>
#include <span>
#include <vector>

#include "examples/render/vec.h"

namespace nacre::host {

/// When light reaches the film, in seconds of the scene; open = close: one moment.
struct Shutter {
  double open = 0, close = 0;
};

/// Where something is while the shutter is open: maps to world space. Times run from 0, where the
/// shutter opens, to 1, where it closes.
///
/// Between two steps the entries of the matrices run straight, so that every point does: this is
/// what Embree does with the steps of an instance, by the same formula, and what shading uses.
/// What turns has as many steps as it takes for the chord to be as good as the arc (see
/// steps_for_angle), and what jumps, or changes its course, a segment before and one behind.
class Motion {
 public:
  /// Steps at equal distances from `begin` to `end`.
  struct Segment {
    float begin = 0.f, end = 1.f;
    std::vector<Affine> steps;  ///< 2 to most_steps + 1.
  };
  static constexpr int most_steps = 128;  ///< From one of Embree's 129 to the next.
  /// What is shorter is no segment: Embree divides by its length, and nobody sees it.
  static constexpr float shortest = 1e-6f;

  Motion() = default;
  explicit Motion(const Affine& still) : still_(still) {}
  /// They follow one another from 0 to 1. Where all matrices are equal, this is still.
  explicit Motion(std::vector<Segment> segments);

  bool is_still() const { return segments_.empty(); }
  /// Of what is still.
  const Affine& still() const { return still_; }
  /// Empty where it is still.
  const std::vector<Segment>& segments() const { return segments_; }
  /// Matrices in all.
  std::size_t steps() const;

  Affine at(float time) const;

 private:
  Affine still_;
  std::vector<Segment> segments_;
};

/// The map of a segment, by Embree's formula.
Affine at(const Motion::Segment& segment, float time);

/// Steps that a turn by so much takes, a power of two: the middle of a chord is within 1/3000 of
/// the radius from its arc as long as most_steps are enough, 6.4 radians.
int steps_for_angle(double radians);

/// What is at `inner` in what moves as `outer` does. Boundaries are those of both.
Motion operator*(const Motion& outer, const Motion& inner);
/// As many segments and steps as that would have, at most.
std::size_t steps_of_product(const Motion& outer, const Motion& inner);

/// Whether there is an inverse at all times.
bool is_invertible(const Motion& motion);

/// Calls `f` with every matrix.
void for_each_step(const Motion& motion, const std::function<void(const Affine&)>& f);

}  // namespace nacre::host
