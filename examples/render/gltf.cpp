#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <fstream>
#include <utility>

#include "examples/render/gltf_accessor.h"
#include "examples/render/load_scene.h"
#include "examples/render/mesh.h"

namespace nacre::host {

namespace {

constexpr int max_node_depth = 256;

Vec3 vec3(const double* v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// glTF 2.0, 3.5.3: a column-major matrix, or T·R·S with a unit quaternion xyzw.
Affine local_transform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    const double* m = node.matrix.data();
    return {vec3(m), vec3(m + 4), vec3(m + 8), vec3(m + 12)};
  }
  Affine a;
  if (node.rotation.size() == 4) {
    double q[4];
    std::copy_n(node.rotation.begin(), 4, q);
    const double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const double s = n > 0 ? 2 / n : 0;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double r[9] = {1 - s * (y * y + z * z), s * (x * y + z * w),     s * (x * z - y * w),
                         s * (x * y - z * w),     1 - s * (x * x + z * z), s * (y * z + x * w),
                         s * (x * z + y * w),     s * (y * z - x * w),     1 - s * (x * x + y * y)};
    a.x = vec3(r), a.y = vec3(r + 3), a.z = vec3(r + 6);
  }
  if (node.scale.size() == 3) {
    const Vec3 scale = vec3(node.scale.data());
    a.x = scale.x * a.x, a.y = scale.y * a.y, a.z = scale.z * a.z;
  }
  if (node.translation.size() == 3) a.origin = vec3(node.translation.data());
  return a;
}

/// Strips and fans as triangles: glTF 2.0, 3.7.2.1.
std::vector<Triangle> assemble(const std::vector<std::uint32_t>& i, int mode) {
  std::vector<Triangle> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t k = 0; k + 2 < i.size(); k += 3)
      triangles.push_back({{i[k], i[k + 1], i[k + 2]}});
    return triangles;
  }
  for (std::size_t k = 0; k + 2 < i.size(); ++k) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      triangles.push_back({{i[0], i[k + 1], i[k + 2]}});
    } else {
      triangles.push_back({{i[k], i[k + 1 + k % 2], i[k + 2 - k % 2]}});
    }
  }
  return triangles;
}

/// "TEXCOORD_1" -> "texcoord1", "COLOR_0" -> "color0", "_TEMP" -> "TEMP".
std::string primvar_name(const std::string& semantic) {
  if (semantic.starts_with("_")) return semantic.substr(1);
  std::string name;
  for (const char c : semantic) {
    if (c != '_') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

class GltfReader {
 public:
  GltfReader(const tinygltf::Model& model, const std::string& file, Diagnostics& diagnostics)
      : model_(model),
        file_(file),
        diagnostics_(diagnostics),
        accessors_(model, file, diagnostics),
        visited_(model.nodes.size(), false) {}

  Scene read() {
    const std::size_t chosen = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
    if (chosen < model_.scenes.size()) {
      for (const int node : model_.scenes[chosen].nodes) visit(node, {}, {}, 0);
    } else {
      error(fmt::format("scenes[{}]", chosen), "there is no such scene",
            fmt::format("an index below {}", model_.scenes.size()), fmt::format("{}", chosen));
    }
    if (!diagnostics_.has_errors() && scene_.meshes.empty()) {
      error("scenes", "the scene has nothing to draw", "a node with a triangle mesh", "none");
    }
    if (diagnostics_.has_errors()) return {};
    return std::move(scene_);
  }

 private:
  void error(std::string path, const char* message, std::string expected, std::string found) {
    diagnostics_.error("bad-gltf", {file_, 0, 0, std::move(path)}, message, std::move(expected),
                       std::move(found));
  }

  void visit(int index, const Affine& parent, const std::string& above, int depth) {
    const std::string path = fmt::format("nodes[{}]", index);
    if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size()) {
      return error(path, "there is no such node",
                   fmt::format("an index below {}", model_.nodes.size()), fmt::format("{}", index));
    }
    // glTF 2.0, 3.5.2: the nodes are a strict tree.
    if (visited_[static_cast<std::size_t>(index)] || depth > max_node_depth) {
      return error(path, "the node hierarchy is not a tree", "one parent per node, no cycle",
                   "a node met twice, or too deep");
    }
    visited_[static_cast<std::size_t>(index)] = true;
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
    const Affine world = parent * local_transform(node);
    const std::string name = node.name.empty() ? above : above + '/' + node.name;
    if (node.mesh >= 0) add_mesh(node, world, name, path);
    if (node.camera >= 0) add_camera(node, world, path);
    for (const int child : node.children) visit(child, world, name, depth + 1);
  }

  void add_mesh(const tinygltf::Node& node, const Affine& world, const std::string& name,
                const std::string& path) {
    if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) {
      return error(path, "there is no such mesh",
                   fmt::format("an index below {}", model_.meshes.size()),
                   fmt::format("{}", node.mesh));
    }
    const float d = determinant(world);
    if (d == 0.f || !std::isfinite(1.f / d)) {
      return error(path, "the transform of the node has no inverse", "a determinant other than 0",
                   fmt::format("{}", d));
    }
    const tinygltf::Mesh& source = model_.meshes[static_cast<std::size_t>(node.mesh)];
    for (std::size_t i = 0; i < source.primitives.size(); ++i) {
      Mesh mesh;
      mesh.mesh_name = source.name.empty() ? fmt::format("mesh{}", node.mesh) : source.name;
      mesh.object_name = node.name.empty() ? mesh.mesh_name : node.name;
      mesh.path = node.name.empty() ? name + '/' + mesh.object_name : name;
      const std::string where = fmt::format("meshes[{}].primitives[{}]", node.mesh, i);
      if (!read_primitive(source.primitives[i], where, mesh)) continue;
      bake_transform(mesh, world);
      if (finish_mesh(mesh, file_, diagnostics_)) scene_.meshes.push_back(std::move(mesh));
    }
  }

  bool read_primitive(const tinygltf::Primitive& primitive, const std::string& where, Mesh& mesh) {
    if (primitive.mode == TINYGLTF_MODE_POINTS || primitive.mode == TINYGLTF_MODE_LINE ||
        primitive.mode == TINYGLTF_MODE_LINE_LOOP || primitive.mode == TINYGLTF_MODE_LINE_STRIP) {
      diagnostics_.warning("not-triangles", {file_, 0, 0, where}, "points and lines are left out");
      return false;
    }
    if (!primitive.attributes.contains("POSITION")) {
      error(where, "the primitive has no positions", "a POSITION attribute", "none");
      return false;
    }
    if (primitive.material >= 0 &&
        static_cast<std::size_t>(primitive.material) < model_.materials.size()) {
      mesh.material_name = model_.materials[static_cast<std::size_t>(primitive.material)].name;
    }
    const std::size_t errors = diagnostics_.error_count();
    read_position(primitive.attributes.at("POSITION"), mesh);
    for (const auto& [semantic, accessor] : primitive.attributes) {
      read_attribute(semantic, accessor, where, mesh);
    }
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
      bool ok = false;
      indices = accessors_.indices(primitive.indices, ok);
    } else {
      for (std::uint32_t i = 0; i < mesh.position.size(); ++i) indices.push_back(i);
    }
    mesh.triangles = assemble(indices, primitive.mode);
    return diagnostics_.error_count() == errors;
  }

  void read_position(int accessor, Mesh& mesh) {
    int n = 0;
    const std::vector<float> f = accessors_.floats(accessor, 3, n);
    for (std::size_t i = 0; i + 2 < f.size(); i += static_cast<std::size_t>(n)) {
      mesh.position.push_back({f[i], f[i + 1], f[i + 2]});
    }
  }

  void read_attribute(const std::string& semantic, int accessor, const std::string& where,
                      Mesh& mesh) {
    if (semantic == "POSITION" || semantic.starts_with("JOINTS_") ||
        semantic.starts_with("WEIGHTS_")) {
      return;
    }
    const int least = semantic == "NORMAL"                ? 3
                      : semantic == "TANGENT"             ? 4
                      : semantic.starts_with("TEXCOORD_") ? 2
                      : semantic.starts_with("COLOR_")    ? 3
                                                          : 1;
    int n = 0;
    std::vector<float> f = accessors_.floats(accessor, least, n);
    if (f.empty()) return;
    const std::size_t count = f.size() / static_cast<std::size_t>(n);
    if (count != mesh.position.size()) {
      return error(where, "an attribute has another length than POSITION",
                   fmt::format("{} elements", mesh.position.size()),
                   fmt::format("{} in {}", count, semantic));
    }
    const auto at = [&f, n](std::size_t i, int c) {
      return f[i * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)];
    };
    for (std::size_t i = 0; i < count && semantic.starts_with("TEXCOORD_"); ++i) {
      f[i * static_cast<std::size_t>(n) + 1] = 1.f - at(i, 1);  // upper left to lower left
    }
    if (semantic == "NORMAL") {
      for (std::size_t i = 0; i < count; ++i) mesh.normal.push_back({at(i, 0), at(i, 1), at(i, 2)});
    } else if (semantic == "TANGENT") {
      for (std::size_t i = 0; i < count; ++i) {
        mesh.tangent.push_back({{at(i, 0), at(i, 1), at(i, 2)}, at(i, 3)});
      }
    } else if (semantic == "TEXCOORD_0") {
      for (std::size_t i = 0; i < count; ++i) mesh.uv.push_back({at(i, 0), at(i, 1)});
    } else {
      mesh.primvars.push_back({primvar_name(semantic), n, std::move(f)});
    }
  }

  /// The first perspective camera; glTF cameras look along -z with +y up.
  void add_camera(const tinygltf::Node& node, const Affine& world, const std::string& path) {
    if (static_cast<std::size_t>(node.camera) >= model_.cameras.size()) {
      return error(path, "there is no such camera",
                   fmt::format("an index below {}", model_.cameras.size()),
                   fmt::format("{}", node.camera));
    }
    const tinygltf::Camera& source = model_.cameras[static_cast<std::size_t>(node.camera)];
    if (scene_.camera || source.type != "perspective") return;
    Camera camera;
    camera.position = world.origin;
    camera.forward = normalize(-world.z);
    camera.right = normalize_or(cross(camera.forward, world.y), perpendicular(camera.forward));
    camera.up = cross(camera.right, camera.forward);
    const auto fov = static_cast<float>(source.perspective.yfov);
    if (fov > 0.f && fov < 3.1415926f) camera.vertical_fov = fov;
    scene_.camera = camera;
  }

  const tinygltf::Model& model_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  GltfAccessors accessors_;
  std::vector<bool> visited_;
  Scene scene_;
};

bool read_whole_file(std::vector<unsigned char>* out, std::string* message, const std::string& path,
                     void* root) {
  namespace fs = std::filesystem;
  std::error_code status;
  const fs::path wanted = fs::weakly_canonical(path, status);
  const fs::path inside = fs::relative(wanted, *static_cast<const fs::path*>(root), status);
  if (status || inside.empty() || *inside.begin() == "..") {
    *message += "refused to read outside the folder of the scene: " + path;
    return false;
  }
  std::ifstream stream(wanted, std::ios::binary);
  out->assign(std::istreambuf_iterator<char>(stream), {});
  if (stream.good() || stream.eof()) return true;
  *message += "cannot read " + path;
  return false;
}

bool file_exists(const std::string& path, void*) {
  std::error_code status;
  return std::filesystem::is_regular_file(path, status);
}

std::string same_path(const std::string& path, void*) { return path; }

bool refuse_write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

bool skip_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                int, void*) {
  return true;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

Scene load_gltf(const std::string& path, Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  std::error_code status;
  fs::path root = fs::weakly_canonical(fs::absolute(path, status).parent_path(), status);
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({file_exists, same_path, read_whole_file, refuse_write, &root});
  parser.SetImageLoader(skip_image, nullptr);
  tinygltf::Model model;
  std::string message, warning;
  const bool binary =
      fs::path(path).extension() != ".gltf" && fs::path(path).extension() != ".GLTF";
  bool ok = false;
  try {
    ok = binary ? parser.LoadBinaryFromFile(&model, &message, &warning, path)
                : parser.LoadASCIIFromFile(&model, &message, &warning, path);
  } catch (const std::exception& fault) {  // tinygltf on an empty file, for one
    message = fault.what();
  }
  if (!ok) {
    diagnostics.error("bad-gltf", {path, 0, 0, {}}, "cannot read the scene", "a glTF 2.0 file",
                      one_line(message.empty() ? warning : message));
    return {};
  }
  Diagnostics found;
  Scene scene = GltfReader(model, path, found).read();
  for (const Diagnostic& d : found.all()) diagnostics.add(d);
  return scene;
}

}  // namespace nacre::host
