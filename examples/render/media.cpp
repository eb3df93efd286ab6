#include "examples/render/media.h"

#include <algorithm>

namespace nacre::host {

bool Media::enter(std::uint32_t mesh, std::uint32_t instance, const Medium& medium,
                  std::uint32_t exit) {
  return push({mesh, instance, medium, exit, {}});
}

bool Media::enter(std::uint32_t mesh, std::uint32_t instance, const Medium& medium,
                  const Dielectric& dielectric) {
  return push({mesh, instance, medium, no_exit, dielectric});
}

bool Media::push(const Inside& inside) {
  if (count_ == capacity) return false;
  inside_[count_++] = inside;
  choose_current();
  return true;
}

std::uint32_t Media::find(std::uint32_t mesh, std::uint32_t instance) const {
  for (std::uint32_t i = count_; i-- > 0;) {
    if (inside_[i].is_of(mesh, instance)) return i;
  }
  return none;
}

std::uint32_t Media::solid(std::uint32_t left_out) const {
  std::uint32_t best = none;
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (!inside_[i].is_solid() || i == left_out) continue;
    const bool wins =
        best == none || inside_[i].dielectric.priority >= inside_[best].dielectric.priority;
    if (wins) best = i;
  }
  return best;
}

/// The solid that there is, or what was entered since and is none.
void Media::choose_current() {
  const std::uint32_t best = solid();
  current_ = best == none ? 0 : best;
  for (std::uint32_t i = current_; i < count_; ++i) {
    if (!inside_[i].is_solid()) current_ = i;
  }
}

void Media::leave(std::uint32_t mesh, std::uint32_t instance) {
  const std::uint32_t at = find(mesh, instance);
  if (at == none) return;
  std::copy(inside_.begin() + at + 1, inside_.begin() + count_, inside_.begin() + at);
  --count_;
  choose_current();
}

float Media::index() const {
  const std::uint32_t best = solid();
  return best == none ? 1.f : inside_[best].dielectric.index;
}

float Media::index_outside(std::uint32_t mesh, std::uint32_t instance) const {
  const std::uint32_t best = solid(find(mesh, instance));
  return best == none ? 1.f : inside_[best].dielectric.index;
}

bool Media::hides_entry(int priority) const {
  const std::uint32_t best = solid();
  return best != none && inside_[best].dielectric.priority > priority;
}

bool Media::hides_exit(std::uint32_t mesh, std::uint32_t instance) const {
  const std::uint32_t own = find(mesh, instance);
  return own != none && inside_[own].is_solid() && solid() != own;
}

}  // namespace nacre::host
