#pragma once

#include <array>

namespace nacre::host {

/// A place in an image, in texels from its upper left corner, or in uv.
struct FlatPlace {
  double x = 0.0, y = 0.0;
};

/// Weights of corners 1 and 2; corner 0 has the rest.
struct FlatWeights {
  double b1 = 0.0, b2 = 0.0;
};

/// A triangle laid out in a plane, of either winding, with an area. What triangles contain is
/// decided by the same numbers for both that meet at an edge, so that no place is strictly inside
/// of both unless they overlap.
class FlatTriangle {
 public:
  FlatTriangle(FlatPlace a, FlatPlace b, FlatPlace c);

  double low_x() const { return low_.x; }
  double low_y() const { return low_.y; }
  double high_x() const { return high_.x; }
  double high_y() const { return high_.y; }
  /// Not negative; 0 where the corners are in a line.
  double area() const;

  bool contains(FlatPlace p) const;           ///< Its edges do belong to it.
  bool contains_strictly(FlatPlace p) const;  ///< They do not.
  /// Within the triangle, whatever rounding does.
  FlatWeights weights(FlatPlace p) const;
  /// Of the place of the triangle that is next to one outside of it; `squared`: how far that is.
  FlatWeights next_to(FlatPlace p, double& squared) const;
  /// By how much weights change from one place to the next along x and y.
  void derivatives(FlatWeights& along_x, FlatWeights& along_y) const;

  /// The x of its part between two y; what the rows of an image are, exactly. False: there is none.
  bool span(double low_y, double high_y, double& low_x, double& high_x) const;

 private:
  std::array<double, 3> edges(FlatPlace p) const;

  std::array<FlatPlace, 3> v_;
  FlatPlace low_, high_;
  double twice_area_;  ///< Negative for clockwise ones, as y goes up.
};

}  // namespace nacre::host
