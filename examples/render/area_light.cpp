#include "examples/render/area_light.h"

#include "examples/render/batch_buffer.h"

namespace nacre::host {

Capabilities ConstantEmitter::capabilities() const {
  Capabilities c;
  c.emits = true;
  c.scatters = false;
  return c;
}

void ConstantEmitter::emission(const ShadingBatch& batch, Lanes3 radiance) const {
  for (std::size_t i = 0; i < batch.count; ++i) {
    const bool front = dot(load(batch.Ng, i), load(batch.wo, i)) > 0.f;
    store(radiance, i, front || two_sided_ ? radiance_ : Vec3{});
  }
}

// Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
Vec2 sample_triangle(Uniform2 u) {
  if (u.y > u.x) {
    const float x = 0.5f * u.x;
    return {x, u.y - x};
  }
  const float y = 0.5f * u.y;
  return {u.x - y, y};
}

}  // namespace nacre::host
