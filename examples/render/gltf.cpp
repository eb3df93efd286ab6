#include <fmt/format.h>

#include <memory>
#include <utility>

#include "examples/render/camera.h"
#include "examples/render/gltf_file.h"
#include "examples/render/gltf_primitive.h"
#include "examples/render/load_scene.h"
#include "examples/render/scene_file.h"

namespace nacre::host {

namespace {

Vec3 vec3(const double* v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// glTF 2.0, 3.5.3: a column-major matrix, or T·R·S with a unit quaternion xyzw.
Affine local_transform(const GltfValue& node) {
  if (const auto m = node["matrix"].numbers(16)) {
    const double* columns = m->data();
    return {vec3(columns), vec3(columns + 4), vec3(columns + 8), vec3(columns + 12)};
  }
  Affine a;
  if (const auto q = node["rotation"].numbers(4)) {
    const double x = (*q)[0], y = (*q)[1], z = (*q)[2], w = (*q)[3];
    const double n = x * x + y * y + z * z + w * w;
    const double s = n > 0 ? 2 / n : 0;
    const double r[9] = {1 - s * (y * y + z * z), s * (x * y + z * w),     s * (x * z - y * w),
                         s * (x * y - z * w),     1 - s * (x * x + z * z), s * (y * z + x * w),
                         s * (x * z + y * w),     s * (y * z - x * w),     1 - s * (x * x + y * y)};
    a.x = vec3(r), a.y = vec3(r + 3), a.z = vec3(r + 6);
    if (!(n > 0)) node["rotation"].error("the rotation has no axis", "a unit quaternion", "zeros");
  }
  if (const auto s = node["scale"].numbers(3)) {
    const Vec3 scale = vec3(s->data());
    a.x = scale.x * a.x, a.y = scale.y * a.y, a.z = scale.z * a.z;
  }
  if (const auto t = node["translation"].numbers(3)) a.origin = vec3(t->data());
  return a;
}

class GltfReader {
 public:
  GltfReader(GltfFile file, const GltfReport& report, std::size_t file_bytes,
             const SceneLimits& limits)
      : json_(std::move(file.root)),
        root_(&json_, {}, report),
        limits_(limits),
        buffers_(root_, std::move(file.binary), file_bytes),
        accessors_(root_, buffers_),
        budget_(limits, report.diagnostics),
        primitives_(root_, accessors_, budget_, dropped_),
        nodes_(root_["nodes"]),
        visited_(nodes_.size(), false) {}

  Scene read() {
    const GltfValue scenes = root_["scenes"], wanted = root_["scene"];
    if (!dropped_.look_at_file(root_)) return {};
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
    Affine parent;
    std::shared_ptr<const std::string> above;
    int depth;
  };

  bool has_errors() const { return root_.report().diagnostics.has_errors(); }

  /// Depth first, in the order of the file.
  void read_scene(const GltfValue& scene) {
    std::vector<Visit> ahead;
    push(scene["nodes"], {}, std::make_shared<const std::string>(), 0, ahead);
    while (!ahead.empty() && !stopped_) {
      const Visit visit = std::move(ahead.back());
      ahead.pop_back();
      read_node(visit, ahead);
    }
  }

  static void push(const GltfValue& list, const Affine& parent,
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
    const Affine world = visit.parent * local_transform(node);
    if (!is_within_reach(world.x) || !is_within_reach(world.y) || !is_within_reach(world.z) ||
        !is_within_reach(world.origin)) {
      return node.error("the transform of the node is out of range",
                        fmt::format("coordinates of at most {:g}", largest_coordinate), "beyond");
    }
    const std::string name = node.name();
    dropped_.look_at_node(node);
    const auto path =
        name.empty() ? visit.above : std::make_shared<const std::string>(*visit.above + '/' + name);
    if (const auto mesh = node["mesh"].index_of(root_["meshes"])) {
      add_mesh(node, name, root_["meshes"][*mesh], *mesh, world, *path);
    }
    if (const auto camera = node["camera"].index_of(root_["cameras"])) {
      add_camera(node, root_["cameras"][*camera], world);
    }
    push(node["children"], world, path, visit.depth + 1, ahead);
  }

  void add_mesh(const GltfValue& node, const std::string& object, const GltfValue& source,
                std::size_t number, const Affine& world, const std::string& path) {
    const float d = determinant(world);
    if (!std::isfinite(d) || !std::isfinite(1.f / d)) {
      return node.error("the transform of the node has no inverse",
                        "a determinant that is neither 0 nor beyond all floats",
                        fmt::format("{:g}", d));
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
      bake_transform(mesh, world);
      // glTF 2.0, 3.7.2.1: without normals faces are flat, and tangents do not count.
      if (mesh.normal.empty()) mesh.tangent.clear();
      const SourceLocation where{root_.report().file, 0, 0, primitives[i].path()};
      if (finish_mesh(mesh, where, root_.report().diagnostics, MissingNormals::flat)) {
        scene_.meshes.push_back(std::move(mesh));
      } else {
        stopped_ = true;
      }
    }
  }

  /// The first perspective camera; glTF cameras look along -z with +y up.
  void add_camera(const GltfValue& node, const GltfValue& source, const Affine& world) {
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
    const Vec3 none = {};
    camera.position = world.origin;
    camera.forward = normalize_or(-world.z, none);
    if (!(dot(camera.forward, camera.forward) > 0.f)) {
      return node.error("the camera looks nowhere", "a transform that keeps the z axis", "zeros");
    }
    camera.right = normalize_or(cross(camera.forward, normalize_or(world.y, none)),
                                perpendicular(camera.forward));
    camera.up = cross(camera.right, camera.forward);
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
  GltfValue nodes_;
  std::vector<bool> visited_;
  Scene scene_;
  int cameras_ = 0;
  bool stopped_ = false;  ///< One wrong mesh is enough: many nodes may show it.
};

}  // namespace

Scene load_gltf(const std::string& path, const SceneLimits& limits, Diagnostics& diagnostics) {
  std::size_t file_bytes = limits.file_bytes;
  auto bytes = read_scene_file(path, {path, 0, 0, {}}, file_bytes, diagnostics);
  if (!bytes) return {};
  Diagnostics found;
  Scene scene;
  if (auto file = parse_gltf_file(path, std::move(*bytes), limits, found)) {
    scene = GltfReader(std::move(*file), {path, found}, file_bytes, limits).read();
  }
  for (const Diagnostic& d : found.all()) diagnostics.add(d);
  return scene;
}

}  // namespace nacre::host
