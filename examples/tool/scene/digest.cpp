#include "examples/tool/scene/digest.h"

#include <type_traits>
#include <vector>

#include "runtime/digest.h"

namespace nacre::tool {

namespace {

/// After how many there are, so that what is of one list cannot be taken for another's.
template <class T>
void add(Sha256& all, const std::vector<T>& numbers) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::uint64_t count = numbers.size();
  all.add({reinterpret_cast<const char*>(&count), sizeof count});
  all.add({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

void add(Sha256& all, const std::string& text) {
  add(all, std::vector<char>(text.begin(), text.end()));
}

void add(Sha256& all, const host::Motion& motion) {
  add(all, std::vector{motion.still()});
  for (const host::Motion::Segment& segment : motion.segments()) {
    add(all, std::vector{segment.begin, segment.end});
    add(all, segment.steps);
  }
}

void add(Sha256& all, const host::Mesh& mesh) {
  for (const std::string& name :
       {mesh.path, mesh.object_name, mesh.mesh_name, mesh.material_name}) {
    add(all, name);
  }
  add(all,
      std::vector{mesh.two_sided ? 1 : 0, mesh.matte ? 1 : 0, mesh.illuminated ? 1 : 0,
                  mesh.light_two_sided ? 1 : 0, mesh.priority, static_cast<int>(mesh.visible_to)});
  if (mesh.light_radiance) add(all, std::vector{*mesh.light_radiance});
  add(all, mesh.triangles);
  add(all, mesh.position);
  add(all, mesh.position_object);
  add(all, mesh.normal);
  add(all, mesh.tangent);
  for (const host::MeshPose& pose : mesh.poses) {
    add(all, pose.position);
    add(all, pose.normal);
    add(all, pose.tangent);
  }
  add(all, mesh.uv);
  add(all, mesh.radius);
  for (const host::Primvar& primvar : mesh.primvars) {
    add(all, primvar.name);
    add(all, std::vector{primvar.components});
    add(all, primvar.values);
  }
  add(all, std::vector{mesh.object_to_world});
  for (const host::Motion& instance : mesh.instances) add(all, instance);
}

}  // namespace

std::string digest_of(const host::Scene& scene) {
  Sha256 all;
  for (const host::Mesh& mesh : scene.meshes) add(all, mesh);
  for (const host::PunctualLight& light : scene.lights) {
    add(all, std::vector{light.color, light.position, light.direction,
                         host::Vec3{light.range, light.inner_cos, light.outer_cos}});
  }
  for (const host::SceneImage& image : scene.materials.images) {
    add(all, image.file);
    if (image.bytes != nullptr) add(all, *image.bytes);
  }
  return to_hex(all.finish());
}

std::string digest_of(const host::Camera& camera, const host::Motion& motion) {
  Sha256 all;
  add(all, std::vector{camera});
  add(all, motion);
  return to_hex(all.finish());
}

}  // namespace nacre::tool
