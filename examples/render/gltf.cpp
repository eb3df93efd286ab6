#include <fmt/format.h>

#include <memory>
#include <utility>

#include "examples/render/camera.h"
#include "examples/render/fibre.h"
#include "examples/render/gltf_animation.h"
#include "examples/render/gltf_file.h"
#include "examples/render/gltf_instancing.h"
#include "examples/render/gltf_light.h"
#include "examples/render/gltf_primitive.h"
#include "examples/render/load_scene.h"
#include "examples/render/scene_file.h"

namespace nacre::host {

namespace {

class GltfReader {
 public:
  GltfReader(GltfFile file, const GltfReport& report, std::size_t file_bytes,
             const SceneLimits& limits, const Shutter& shutter)
      : json_(std::move(file.root)),
        root_(&json_, {}, report),
        limits_(limits),
        buffers_(root_, std::move(file.binary), file_bytes),
        accessors_(root_, buffers_),
        budget_(limits, report.diagnostics),
        primitives_(root_, accessors_, budget_, dropped_),
        animation_(root_, accessors_, budget_, dropped_, shutter),
        instancing_(accessors_, budget_, dropped_),
        nodes_(root_["nodes"]),
        visited_(nodes_.size(), false) {}

  Scene read() {
    const GltfValue scenes = root_["scenes"], wanted = root_["scene"];
    if (!dropped_.look_at_file(root_) || !animation_.read()) return {};
    const auto chosen = wanted ? wanted.index_of(scenes) : std::optional<std::size_t>(0);
    if (!wanted && scenes.size() > 1) {
      dropped_.say("several-scenes", scenes, "the first scene is shown, for the file names none",
                   "\"scene\" with an index", fmt::format("{} scenes", scenes.size()));
    }
    if (chosen && scenes.need("an array of scenes")) read_scene(scenes[*chosen]);
    if (!has_errors() && scene_.meshes.empty()) {
      root_["scenes"].error("the scene has nothing to draw", "a node with a triangle mesh", "none");
    }
    if (cameras_ > 1) {
      dropped_.say("several-cameras", root_["cameras"], "the first camera of the scene is taken",
                   "one camera", fmt::format("{}", cameras_));
    }
    if (has_errors()) return {};
    return std::move(scene_);
  }

 private:
  /// A node on its way: what stands above it is shared with its siblings.
  struct Visit {
    GltfValue index;
    std::shared_ptr<const Motion> parent;
    std::shared_ptr<const std::string> above;
    int depth;
  };

  bool has_errors() const { return root_.report().diagnostics.has_errors(); }

  /// Depth first, in the order of the file.
  void read_scene(const GltfValue& scene) {
    std::vector<Visit> ahead;
    push(scene["nodes"], std::make_shared<const Motion>(), std::make_shared<const std::string>(), 0,
         ahead);
    while (!ahead.empty() && !stopped_) {
      const Visit visit = std::move(ahead.back());
      ahead.pop_back();
      read_node(visit, ahead);
    }
  }

  static void push(const GltfValue& list, const std::shared_ptr<const Motion>& parent,
                   const std::shared_ptr<const std::string>& above, int depth,
                   std::vector<Visit>& ahead) {
    for (std::size_t i = list.size(); i-- > 0;) ahead.push_back({list[i], parent, above, depth});
  }

  void read_node(const Visit& visit, std::vector<Visit>& ahead) {
    const auto index = visit.index.index_of(nodes_);
    if (!index) return;
    const GltfValue node = nodes_[*index];
    // glTF 2.0, 3.5.2: the nodes are a strict tree.
    if (visited_[*index]) {
      return visit.index.error("the node hierarchy is not a tree", "one parent per node, no cycle",
                               node.path() + " met twice");
    }
    visited_[*index] = true;
    if (visit.depth == limits_.node_depth) {
      return node.error("the nodes are nested too deeply",
                        fmt::format("at most {} levels (--max-node-depth)", limits_.node_depth),
                        "more");
    }
    const auto world = world_motion(*visit.parent, *index, node);
    stopped_ = stopped_ || world == nullptr;
    if (stopped_) return;
    const std::string name = node.name();
    dropped_.look_at_node(node);
    const auto path =
        name.empty() ? visit.above : std::make_shared<const std::string>(*visit.above + '/' + name);
    if (const auto mesh = node["mesh"].index_of(root_["meshes"])) {
      add_mesh(node, name, root_["meshes"][*mesh], *mesh, *world, *path);
    }
    if (const auto camera = node["camera"].index_of(root_["cameras"])) {
      add_camera(node, root_["cameras"][*camera], *world);
    }
    const GltfValue lights = root_["extensions"]["KHR_lights_punctual"]["lights"];
    const GltfValue shines = node["extensions"]["KHR_lights_punctual"]["light"];
    if (const auto light = shines.index_of(lights)) add_light(node, lights[*light], *world);
    push(node["children"], world, path, visit.depth + 1, ahead);
  }

  /// Null after an error.
  std::shared_ptr<const Motion> world_motion(const Motion& parent, std::size_t number,
                                             const GltfValue& node) {
    const auto local = animation_.local_motion(number, node);
    if (!local) return nullptr;
    const bool moves = !parent.is_still() || !local->is_still();
    const SourceLocation where{root_.report().file, 0, 0, node.path()};
    const std::size_t bytes = steps_of_product(parent, *local) * sizeof(Affine);
    if (moves && !budget_.take_bytes(where, bytes)) return nullptr;
    auto world = std::make_shared<const Motion>(parent * *local);
    bool is_near = true;
    for_each_step(*world, [&](const Affine& m) {
      is_near = is_near && is_within_reach(m.x) && is_within_reach(m.y) && is_within_reach(m.z) &&
                is_within_reach(m.origin);
    });
    if (is_near) return world;
    node.error("the transform of the node is out of range",
               fmt::format("coordinates of at most {:g}", largest_coordinate), "beyond");
    return nullptr;
  }

  void add_mesh(const GltfValue& node, const std::string& object, const GltfValue& source,
                std::size_t number, const Motion& world, const std::string& path) {
    const auto places = instancing_.places(node, world);
    if (!places) {
      stopped_ = true;
      return;
    }
    const GltfValue primitives = source["primitives"];
    if (primitives.size() == 0)
      primitives.error("the mesh has no primitive", "one or more", "none");
    const std::string name = source.name();
    for (std::size_t i = 0; i < primitives.size() && !stopped_; ++i) {
      Mesh mesh;
      mesh.mesh_name = name.empty() ? fmt::format("mesh{}", number) : name;
      mesh.object_name = object.empty() ? mesh.mesh_name : object;
      mesh.path = object.empty() ? path + '/' + mesh.object_name : path;
      if (!primitives_.read(primitives[i], mesh)) {
        stopped_ = has_errors();
        continue;
      }
      const bool is_baked = places->size() == 1 && places->front().is_still();
      if (is_baked) bake_transform(mesh, places->front().still());
      // glTF 2.0, 3.7.2.1: without normals faces are flat, and tangents do not count.
      if (mesh.normal.empty()) mesh.tangent.clear();
      const SourceLocation where{root_.report().file, 0, 0, primitives[i].path()};
      Diagnostics& diagnostics = root_.report().diagnostics;
      const bool is_whole = mesh.is_fibres()
                                ? finish_fibres(mesh, where, diagnostics)
                                : finish_mesh(mesh, where, diagnostics, MissingNormals::flat);
      if (is_whole && (is_baked || instancing_.place(mesh, *places, primitives[i]))) {
        scene_.meshes.push_back(std::move(mesh));
      } else {
        stopped_ = true;
      }
    }
  }

  void add_light(const GltfValue& node, const GltfValue& source, const Motion& world) {
    if (!world.is_still()) {
      dropped_.say("light-stands", node,
                   "a light that moves stands where it is as the shutter opens");
    }
    auto light = read_light(source, world.at(0.f));
    if (!light) return;
    light->name = node.name();
    scene_.lights.push_back(*light);
  }

  /// The first perspective camera; glTF cameras look along -z with +y up.
  void add_camera(const GltfValue& node, const GltfValue& source, const Motion& world) {
    const auto type = source["type"].need("\"perspective\"").text();
    if (!type) return;
    if (*type != "perspective") {
      return dropped_.say("camera-not-rendered", source["type"],
                          "this kind of camera is not supported and left out", "\"perspective\"",
                          source["type"].shown());
    }
    if (++cameras_ > 1) return;
    const GltfValue yfov = source["perspective"]["yfov"];
    const auto fov = yfov.need("an angle in radians").number();
    if (!fov) return;
    Camera camera;
    camera.vertical_fov = static_cast<float>(*fov);
    if (!(camera.vertical_fov >= smallest_fov && camera.vertical_fov <= largest_fov)) {
      return yfov.error("the field of view is out of range",
                        fmt::format("{:g} to {:g} radians", smallest_fov, largest_fov),
                        yfov.shown());
    }
    if (!place_camera(world, camera, scene_.camera_motion)) {
      return node.error("the camera looks nowhere", "a transform that keeps the z axis", "zeros");
    }
    scene_.camera = camera;
  }

  nlohmann::json json_;
  GltfValue root_;
  SceneLimits limits_;
  GltfBuffers buffers_;
  GltfAccessors accessors_;
  SceneBudget budget_;
  GltfDropped dropped_;
  GltfPrimitives primitives_;
  GltfAnimation animation_;
  GltfInstancing instancing_;
  GltfValue nodes_;
  std::vector<bool> visited_;
  Scene scene_;
  int cameras_ = 0;
  bool stopped_ = false;  ///< One wrong mesh is enough: many nodes may show it.
};

}  // namespace

Scene load_gltf(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics,
                const Shutter& shutter) {
  std::size_t file_bytes = limits.file_bytes;
  auto bytes = read_scene_file(path, {path, 0, 0, {}}, file_bytes, diagnostics);
  if (!bytes) return {};
  Diagnostics found;
  Scene scene;
  if (auto file = parse_gltf_file(path, std::move(*bytes), limits, found)) {
    scene = GltfReader(std::move(*file), {path, found}, file_bytes, limits, shutter).read();
  }
  for (const Diagnostic& d : found.all()) diagnostics.add(d);
  return scene;
}

}  // namespace nacre::host
