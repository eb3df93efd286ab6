#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "examples/render/medium.h"

namespace nacre::host {

/// What bends light at the border of a solid, where solids lie within one another.
struct Dielectric {
  float index = 0.f;  ///< Of refraction, relative to vacuum; 0: no such solid.
  int priority = 0;   ///< Where solids overlap the one of the highest is there.
};

/// What a path is inside of. Where solids overlap, the one of the highest priority is what there
/// is, and of several the one that was entered last; what is hidden by it comes back when it is
/// left (Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics
/// Tools 7(2), 2002). What is no such solid, as a volume, is there until another is entered.
class Media {
 public:
  static constexpr std::uint32_t no_exit = ~0u;
  static constexpr std::uint32_t capacity = 6;

  Media() = default;
  Media(const Media& other) { *this = other; }
  /// Copies what light is inside of, which is little of the room that there is.
  Media& operator=(const Media& other) {
    count_ = other.count_;
    current_ = other.current_;
    for (std::uint32_t i = 0; i < count_; ++i) inside_[i] = other.inside_[i];
    return *this;
  }

  bool empty() const { return count_ == 0; }
  /// Not empty() before.
  const Medium& current() const { return inside_[current_].medium; }

  /// False, and nothing is done, where more is nested than anybody nests. `exit`: the material
  /// that light meets on the inside of that mesh, if another than on the outside.
  bool enter(std::uint32_t mesh, std::uint32_t instance, const Medium& medium,
             std::uint32_t exit = no_exit);
  /// The same of a solid that bends light.
  bool enter(std::uint32_t mesh, std::uint32_t instance, const Medium& medium,
             const Dielectric& dielectric);
  /// `exit` of what the path is inside of, if that is this mesh; else no_exit.
  std::uint32_t exit(std::uint32_t mesh, std::uint32_t instance) const {
    if (empty()) return no_exit;
    const Inside& last = inside_[current_];
    return last.is_of(mesh, instance) ? last.exit : no_exit;
  }
  /// Whether light goes straight out of all that the path is inside of, that mesh apart.
  bool is_open(std::uint32_t mesh = ~0u, std::uint32_t instance = 0) const {
    return std::all_of(inside_.begin(), inside_.begin() + count_, [&](const Inside& each) {
      return each.medium.is_open || each.is_of(mesh, instance);
    });
  }
  /// Which mesh and instance current() is of.
  std::uint32_t mesh() const { return inside_[current_].mesh; }
  std::uint32_t instance() const { return inside_[current_].instance; }
  /// Nothing is done where the path is not inside of that.
  void leave(std::uint32_t mesh, std::uint32_t instance);

  /// Of refraction, of the solid that there is; 1, vacuum, in none.
  float index() const;
  /// The same of what there is when that mesh is left.
  float index_outside(std::uint32_t mesh, std::uint32_t instance) const;
  /// Whether a solid of that priority is hidden where light enters it: there is one of a higher.
  bool hides_entry(int priority) const;
  /// Whether it is hidden where light leaves it: there is another that light is inside of, too.
  bool hides_exit(std::uint32_t mesh, std::uint32_t instance) const;

 private:
  struct Inside {
    std::uint32_t mesh, instance;
    Medium medium;
    std::uint32_t exit;
    Dielectric dielectric;
    bool is_solid() const { return dielectric.index > 0.f; }
    bool is_of(std::uint32_t m, std::uint32_t i) const { return mesh == m && instance == i; }
  };
  static constexpr std::uint32_t none = ~0u;

  bool push(const Inside& inside);
  /// The latest of that mesh, or none.
  std::uint32_t find(std::uint32_t mesh, std::uint32_t instance) const;
  /// The solid that there is, but for that one.
  std::uint32_t solid(std::uint32_t left_out = none) const;
  void choose_current();

  std::uint32_t count_ = 0;
  std::uint32_t current_ = 0;
  std::array<Inside, capacity> inside_ = {};
};

}  // namespace nacre::host
