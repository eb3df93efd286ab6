#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>
#include <utility>

#include "examples/render/camera.h"
#include "examples/render/fibre.h"
#include "examples/render/gltf_animation.h"
#include "examples/render/gltf_deform.h"
#include "examples/render/gltf_file.h"
#include "examples/render/gltf_instancing.h"
#include "examples/render/gltf_light.h"
#include "examples/render/gltf_material.h"
#include "examples/render/gltf_primitive.h"
#include "examples/render/gltf_skin.h"
#include "examples/render/gltf_variants.h"
#include "examples/render/load_scene.h"
#include "examples/render/scene_file.h"

namespace nacre::host {

namespace {

class GltfReader {
 public:
  GltfReader(GltfFile file, const GltfReport& report, std::size_t file_bytes,
             const SceneLimits& limits, const Shutter& shutter, const SceneLooks& looks)
      : json_(std::move(file.root)),
        root_(&json_, {}, report),
        limits_(limits),
        looks_(looks),
        buffers_(root_, std::move(file.binary), file_bytes),
        budget_(limits, report.diagnostics),
        accessors_(root_, buffers_, budget_),
        variants_(root_),
        primitives_(root_, buffers_, accessors_, budget_, dropped_, variants_),
        animation_(root_, accessors_, budget_, dropped_, shutter),
        deform_(accessors_, animation_, budget_),
        instancing_(accessors_, budget_, dropped_),
        nodes_(root_["nodes"]),
        worlds_(nodes_.size()) {}

  Scene read() {
    const GltfValue scenes = root_["scenes"], wanted = root_["scene"];
    if (!dropped_.look_at_file(root_, looks_.materials)) return {};
    if (!variants_.choose(looks_.variant) || !animation_.read(looks_.animation)) return {};
    scene_.is_animated = root_["animations"].size() > 0;
    const auto chosen = wanted ? wanted.index_of(scenes) : std::optional<std::size_t>(0);
    if (!wanted && scenes.size() > 1) {
      dropped_.say("several-scenes", scenes, "the first scene is shown, for the file names none",
                   "\"scene\" with an index", fmt::format("{} scenes", scenes.size()));
    }
    if (chosen && scenes.need("an array of scenes")) read_scene(scenes[*chosen]);
    if (!has_errors() && scene_.meshes.empty()) {
      root_["scenes"].error("the scene has nothing to draw", "a node with a triangle mesh", "none");
    }
    if (looks_.materials) read_materials();
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

  /// A node with a mesh, and where it is.
  struct Placed {
    std::size_t number;
    std::string name;
    std::shared_ptr<const Motion> world;
    std::string path;
  };

  bool has_errors() const { return root_.report().diagnostics.has_errors(); }

  void read_materials() {
    GltfTextures textures(root_, buffers_, dropped_);
    const GltfValue materials = root_["materials"];
    for (std::size_t i = 0; i < materials.size(); ++i) {
      scene_.materials.all.push_back(read_material(materials[i], textures, dropped_));
    }
    scene_.materials.images = textures.take_images();
  }

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
    for (std::size_t i = 0; i < skinned_.size() && !stopped_; ++i) add_mesh(skinned_[i]);
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
    if (worlds_[*index] != nullptr) {
      return visit.index.error("the node hierarchy is not a tree", "one parent per node, no cycle",
                               node.path() + " met twice");
    }
    if (visit.depth == limits_.node_depth) {
      return node.error("the nodes are nested too deeply",
                        fmt::format("at most {} levels (--max-node-depth)", limits_.node_depth),
                        "more");
    }
    const auto world = world_motion(*visit.parent, *index, node);
    stopped_ = stopped_ || world == nullptr;
    if (stopped_) return;
    worlds_[*index] = world;
    const std::string name = node.name();
    dropped_.look_at_node(node);
    const auto path =
        name.empty() ? visit.above : std::make_shared<const std::string>(*visit.above + '/' + name);
    if (node["mesh"]) {
      Placed placed{*index, name, world, *path};
      if (node["skin"]) {
        skinned_.push_back(std::move(placed));
      } else {
        add_mesh(placed);
      }
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
    const SourceLocation where = node.location();
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

  /// Null after an error.
  const GltfSkin* skin(const GltfValue& index) {
    const GltfValue skins = root_["skins"];
    const auto number = index.index_of(skins);
    if (!number) return nullptr;
    if (const auto known = skins_.find(*number); known != skins_.end()) return &known->second;
    auto read = GltfSkin::read(root_, skins[*number], accessors_, budget_,
                               [this](std::size_t node) { return worlds_[node].get(); });
    if (!read) return nullptr;
    return &skins_.emplace(*number, std::move(*read)).first->second;
  }

  void add_mesh(const Placed& placed) {
    const GltfValue node = nodes_[placed.number];
    const auto number = node["mesh"].index_of(root_["meshes"]);
    if (!number) return;
    const GltfValue source = root_["meshes"][*number];
    const std::string& object = placed.name;
    const std::string& path = placed.path;
    const GltfSkin* const bones = node["skin"] ? skin(node["skin"]) : nullptr;
    stopped_ = node["skin"] && bones == nullptr;
    if (stopped_) return;
    if (bones != nullptr && node["extensions"]["EXT_mesh_gpu_instancing"]) {
      dropped_.say("skinned-instances", node, "a mesh with a skin is shown once, not as instances",
                   "instances of a mesh without a skin");
    }
    // glTF 2.0, 3.7.3.3: where the node itself is does not count for a skin.
    const Motion world = bones == nullptr ? *placed.world : Motion();
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
      mesh.mesh_name = name.empty() ? fmt::format("mesh{}", *number) : name;
      mesh.object_name = object.empty() ? mesh.mesh_name : object;
      mesh.path = object.empty() ? path + '/' + mesh.object_name : path;
      if (!primitives_.read(primitives[i], mesh)) {
        stopped_ = has_errors();
        continue;
      }
      if (!mesh.is_fibres() &&
          !deform_.apply(node, placed.number, source, primitives[i], bones, mesh)) {
        stopped_ = true;
        return;
      }
      const bool is_baked = bones == nullptr && places->size() == 1 && places->front().is_still();
      if (is_baked) bake_transform(mesh, places->front().still());
      // glTF 2.0, 3.7.2.1: without normals faces are flat, and tangents do not count.
      if (mesh.normal.empty()) mesh.tangent.clear();
      const SourceLocation where = primitives[i].location();
      Diagnostics& diagnostics = root_.report().diagnostics;
      const bool is_whole = mesh.is_fibres()
                                ? finish_fibres(mesh, where, diagnostics)
                                : finish_mesh(mesh, where, diagnostics, MissingNormals::flat);
      const bool stays = is_baked || bones != nullptr;
      if (is_whole && (stays || instancing_.place(mesh, *places, primitives[i]))) {
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

  /// Of a node, or else of the camera that it holds; with a number where it is taken.
  std::string camera_name(const GltfValue& node, const GltfValue& source) {
    std::string wanted = node.name();
    if (wanted.empty()) wanted = source.name();
    if (wanted.empty()) wanted = "camera";
    std::string name = wanted;
    for (int number = 2; !camera_names_.insert(name).second; ++number) {
      name = fmt::format("{}_{}", wanted, number);
    }
    return name;
  }

  /// Perspective ones; glTF cameras look along -z with +y up.
  void add_camera(const GltfValue& node, const GltfValue& source, const Motion& world) {
    const auto type = source["type"].need("\"perspective\"").text();
    if (!type) return;
    if (*type != "perspective") {
      return dropped_.say("camera-not-rendered", source["type"],
                          "this kind of camera is not supported and left out", "\"perspective\"",
                          source["type"].shown());
    }
    const GltfValue yfov = source["perspective"]["yfov"];
    const auto fov = yfov.need("an angle in radians").number();
    if (!fov) return;
    SceneCamera added{camera_name(node, source), {}};
    Camera& camera = added.camera;
    camera.vertical_fov = static_cast<float>(*fov);
    if (!(camera.vertical_fov >= smallest_fov && camera.vertical_fov <= largest_fov)) {
      return yfov.error("the field of view is out of range",
                        fmt::format("{:g} to {:g} radians", smallest_fov, largest_fov),
                        yfov.shown());
    }
    if (!place_camera(world, camera, added.motion)) {
      return node.error("the camera looks nowhere", "a transform that keeps the z axis", "zeros");
    }
    scene_.cameras.push_back(std::move(added));
  }

  nlohmann::json json_;
  GltfValue root_;
  SceneLimits limits_;
  SceneLooks looks_;
  GltfBuffers buffers_;
  SceneBudget budget_;
  GltfAccessors accessors_;
  GltfDropped dropped_;
  GltfVariants variants_;
  GltfPrimitives primitives_;
  GltfAnimation animation_;
  GltfDeform deform_;
  GltfInstancing instancing_;
  GltfValue nodes_;
  std::vector<std::shared_ptr<const Motion>> worlds_;  ///< Of nodes that were met.
  std::vector<Placed> skinned_;                        ///< For when all joints are met.
  std::map<std::size_t, GltfSkin> skins_;
  Scene scene_;
  std::set<std::string> camera_names_;
  bool stopped_ = false;  ///< One wrong mesh is enough: many nodes may show it.
};

}  // namespace

Scene load_gltf(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics,
                const Shutter& shutter, const SceneLooks& looks) {
  std::size_t file_bytes = limits.file_bytes;
  auto bytes = read_scene_file(path, {path, 0, 0, {}}, file_bytes, diagnostics);
  if (!bytes) return {};
  Diagnostics found;
  Scene scene;
  if (auto file = parse_gltf_file(path, std::move(*bytes), limits, found)) {
    scene = GltfReader(std::move(*file), {path, found}, file_bytes, limits, shutter, looks).read();
  }
  for (const Diagnostic& d : found.all()) diagnostics.add(d);
  return scene;
}

}  // namespace nacre::host
