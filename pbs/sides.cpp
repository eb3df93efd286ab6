#include "pbs/sides.h"

#include <utility>

namespace nacre {

namespace {

SurfacePtr with_walls(const Surface& surface, Bool thin) {
  auto copy = std::make_shared<Surface>(surface);
  copy->thin_walled = thin;
  return copy;
}

}  // namespace

SurfaceSides surface_sides(SurfacePtr front, SurfacePtr back) {
  if (front == nullptr) return {std::move(back), nullptr};
  if (back == nullptr || back == front) return {std::move(front), nullptr};
  const Bool thin = front->thin_walled | back->thin_walled;
  const bool bounds_solid = front->bsdf != nullptr || back->bsdf != nullptr;
  if (bounds_solid && thin.is_constant(false)) return {std::move(front), nullptr};
  return {with_walls(*front, thin), with_walls(*back, thin)};
}

}  // namespace nacre
