#include "examples/render/volumes_around.h"

#include <algorithm>
#include <span>
#include <vector>

#include "examples/render/medium_lanes.h"
#include "examples/render/offset.h"

namespace nacre::host {

namespace {

/// Whether light at a point of that mesh goes into something of its own.
bool is_filled(const RenderContext& context, std::uint32_t mesh) {
  const std::uint32_t front = context.front_materials[mesh];
  return context.materials[front].capabilities.is_volume || context.is_solid(mesh);
}

/// Where the border of what is around was met.
void enter_solid(const RenderContext& context, const SurfacePoint& border, BatchBuffer& buffer,
                 Media& media) {
  const Material& material = context.materials[context.front_materials[border.mesh]];
  context.geometry.fill({&border, 1}, material.capabilities, context.camera, buffer);
  material.shader->interior(buffer.batch, buffer.interior);
  media.enter(border.mesh, border.instance, medium_of(buffer.interior, 0),
              dielectric_of(buffer.interior, 0, context.scene.meshes[border.mesh].priority));
}

/// What a volume is of at its border; more is known only of one that is alike everywhere.
Medium medium_behind(const RenderContext& context, const SurfacePoint& border,
                     BatchBuffer& buffer) {
  const std::uint32_t index = context.front_materials[border.mesh];
  const Material& material = context.materials[index];
  if (material.capabilities.volume_varies)
    return varying_medium(index, context.bounds[border.mesh]);
  context.geometry.fill({&border, 1}, material.capabilities, context.camera, buffer);
  material.shader->volume(buffer.batch, buffer.within);
  return medium_of(buffer.within, 0);
}

}  // namespace

Media volumes_around(const RenderContext& context, Vec3 P, float time) {
  // More surfaces than these are behind one another in no scene that a ray gets through.
  constexpr int most_surfaces = 4096;
  const auto same = [](const SurfacePoint& a) {
    return [&a](const SurfacePoint& b) { return a.mesh == b.mesh && a.instance == b.instance; };
  };
  // Along no axis and no diagonal: there are edges of what people model.
  Ray ray = {P, normalize({0.3647f, 0.8121f, 0.4557f}), INFINITY, ray_any, time};
  std::vector<SurfacePoint> entered, around;
  for (int i = 0; i < most_surfaces; ++i) {
    Hit hit;
    context.bvh.intersect({&ray, 1}, {&hit, 1}, false);
    if (hit.missed()) break;
    const SurfacePoint point = {.mesh = hit.mesh,
                                .triangle = hit.triangle,
                                .u = hit.u,
                                .v = hit.v,
                                .wo = -ray.direction,
                                .instance = hit.instance,
                                .time = time,
                                .normal = hit.normal};
    const Vec3 ng = surface_normal(context.scene, point);
    const bool leaves = dot(ng, ray.direction) > 0.f;
    ray.origin = offset_point(surface_position(context.scene, point), leaves ? ng : -ng);
    if (!is_filled(context, hit.mesh)) continue;
    if (!leaves) {
      entered.push_back(point);
    } else if (const auto at = std::ranges::find_if(entered, same(point)); at != entered.end()) {
      entered.erase(at);
    } else {
      around.push_back(point);
    }
  }
  BatchBuffer buffer(1, 0, context.primvars);
  buffer.batch.time = context.settings.time;
  buffer.batch.frame = context.settings.frame;
  Media media;
  for (auto border = around.rbegin(); border != around.rend(); ++border) {
    if (context.is_solid(border->mesh)) {
      enter_solid(context, *border, buffer, media);
      continue;
    }
    const Medium medium = medium_behind(context, *border, buffer);
    if (!medium.is_empty()) media.enter(border->mesh, border->instance, medium);
  }
  return media;
}

}  // namespace nacre::host
