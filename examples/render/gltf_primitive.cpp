#include "examples/render/gltf_primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

#include "examples/render/fibre.h"
#include "examples/render/gltf_draco.h"

namespace nacre::host {

namespace {

/// glTF 2.0, 5.24.4.
enum Mode : std::size_t {
  mode_lines = 1,
  mode_loop = 2,
  mode_line_strip = 3,
  mode_triangles = 4,
  mode_strip = 5,
  mode_fan = 6
};

/// Strips and fans as triangles: glTF 2.0, 3.7.2.1.
std::vector<Triangle> assemble(const std::vector<std::uint32_t>& i, std::size_t mode) {
  std::vector<Triangle> triangles;
  triangles.reserve(mode == mode_triangles ? i.size() / 3 : i.size());
  if (mode == mode_triangles) {
    for (std::size_t k = 0; k + 2 < i.size(); k += 3)
      triangles.push_back({{i[k], i[k + 1], i[k + 2]}});
    return triangles;
  }
  for (std::size_t k = 0; k + 2 < i.size(); ++k) {
    if (mode == mode_fan) {
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

/// Components that an attribute has at least.
int least_components(const std::string& semantic) {
  if (semantic == "TANGENT") return 4;
  if (semantic == "POSITION" || semantic == "NORMAL" || semantic.starts_with("COLOR_")) return 3;
  return semantic.starts_with("TEXCOORD_") ? 2 : 1;
}

}  // namespace

bool GltfPrimitives::read(const GltfValue& primitive, Mesh& mesh) {
  const std::size_t errors = primitive.report().diagnostics.error_count();
  const auto ok = [&] { return primitive.report().diagnostics.error_count() == errors; };
  const std::size_t mode = primitive["mode"].count().value_or(mode_triangles);
  const bool is_fibres = mode < mode_triangles && mode >= mode_lines &&
                         static_cast<bool>(primitive["attributes"]["_RADIUS"]);
  if (mode < mode_triangles && !is_fibres && ok()) {
    primitive.report().warning("not-triangles", primitive.path(),
                               "points, and lines without a radius, are left out",
                               "triangles, or lines with an attribute _RADIUS");
    return false;
  }
  if (mode > mode_fan)
    primitive["mode"].error("there is no such mode", "0 to 6", std::to_string(mode));
  dropped_.look_at_primitive(primitive);
  mesh.material = variants_.material_of(primitive).index_of(root_["materials"]);
  if (mesh.material) mesh.material_name = root_["materials"][*mesh.material].name();
  if (!unpack_draco(root_, primitive, buffers_, accessors_, budget_)) return false;
  const GltfValue attributes = primitive["attributes"];
  const GltfValue position = attributes["POSITION"];
  std::optional<GltfAccessor> indices;
  if (primitive["indices"]) indices = accessors_.indices(primitive["indices"]);
  std::vector<Attribute> list;
  if (!position.need("the index of an accessor") || !open_attributes(attributes, list) || !ok()) {
    return false;
  }
  if (is_fibres) return read_lines(primitive, mode, list, indices, mesh) && ok();
  const std::size_t vertices = list.front().accessor.count;
  if (!read_triangles(primitive, mode, vertices, indices, mesh)) return false;
  for (const Attribute& attribute : list) read_attribute(attribute, mesh);
  return ok();
}

/// POSITION first. False after an error.
bool GltfPrimitives::open_attributes(const GltfValue& attributes, std::vector<Attribute>& list) {
  std::vector<std::string> names = attributes.names();
  std::erase_if(names, [](const std::string& name) {  // Of skins: see gltf_skin.h.
    return name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
  });
  const auto position = std::ranges::find(names, "POSITION");
  if (position != names.end()) std::rotate(names.begin(), position, position + 1);
  for (std::string& name : names) {
    const GltfValue index = attributes[name.c_str()];
    const auto accessor = accessors_.attribute(index, least_components(name));
    if (!accessor) return false;
    list.push_back({std::move(name), index, *accessor});
    if (accessor->count == list.front().accessor.count) continue;
    index.error("an attribute has another length than POSITION",
                fmt::format("{} elements", list.front().accessor.count),
                fmt::format("{}", accessor->count));
    return false;
  }
  return true;
}

bool GltfPrimitives::read_triangles(const GltfValue& primitive, std::size_t mode,
                                    std::size_t vertices, std::optional<GltfAccessor> indices,
                                    Mesh& mesh) {
  const std::size_t corners = indices ? indices->count : vertices;
  if (corners < 3 || (mode == mode_triangles && corners % 3 != 0)) {
    primitive[indices ? "indices" : "attributes"].error(
        "the corners make no triangles", mode == mode_triangles ? "a multiple of 3" : "3 or more",
        fmt::format("{}", corners));
    return false;
  }
  const std::size_t triangles = mode == mode_triangles ? corners / 3 : corners - 2;
  // Without normals each corner of what may bend is a vertex of its own.
  const GltfValue attributes = primitive["attributes"];
  const bool may_bend = primitive["targets"] || attributes["JOINTS_0"];
  const bool are_split = may_bend && !attributes["NORMAL"];
  const std::size_t kept = vertices + (are_split ? 3 * triangles : 0);
  std::size_t other = mesh.path.size() + mesh.object_name.size() + mesh.mesh_name.size() +
                      mesh.material_name.size();
  // A primitive variable has up to four floats a vertex; the others are counted with the mesh.
  for (const std::string& name : attributes.names()) {
    const bool is_own =
        name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name == "TEXCOORD_0";
    other += name.size() + (is_own ? 0 : 16 * kept);
  }
  if (!budget_.take(primitive.location(), kept, triangles, other)) {
    return false;
  }
  std::vector<std::uint32_t> numbers;
  if (indices) {
    numbers = GltfAccessors::integers(*indices);
  } else {
    numbers.resize(vertices);
    std::iota(numbers.begin(), numbers.end(), 0u);
  }
  mesh.triangles = assemble(numbers, mode);
  return true;
}

/// Each line gets vertices of its own, in its order: pieces of fibres are between neighbours.
bool GltfPrimitives::read_lines(const GltfValue& primitive, std::size_t mode,
                                std::vector<Attribute>& list, std::optional<GltfAccessor> indices,
                                Mesh& mesh) {
  const std::size_t vertices = list.front().accessor.count;
  std::size_t corners = indices ? indices->count : vertices;
  if (corners < 2 || (mode == mode_lines && corners % 2 != 0)) {
    primitive[indices ? "indices" : "attributes"].error(
        "the vertices make no lines", mode == mode_lines ? "a multiple of 2" : "2 or more",
        fmt::format("{}", corners));
    return false;
  }
  if (mode == mode_loop) ++corners;
  std::size_t other = mesh.path.size() + mesh.object_name.size() + mesh.mesh_name.size() +
                      mesh.material_name.size();
  for (const Attribute& attribute : list) {
    other += attribute.semantic.size() + 16 * (vertices + corners);
  }
  if (!budget_.take(primitive.location(), vertices + corners, corners, other)) {
    return false;
  }
  std::vector<std::uint32_t> order;
  if (indices) {
    order = GltfAccessors::integers(*indices);
  } else {
    order.resize(vertices);
    std::iota(order.begin(), order.end(), 0u);
  }
  if (mode == mode_loop) order.push_back(order.front());
  const auto outside = std::ranges::find_if(order, [&](std::uint32_t v) { return v >= vertices; });
  if (outside != order.end()) {
    primitive["indices"].error("an index is out of range", fmt::format("less than {}", vertices),
                               fmt::format("{}", *outside));
    return false;
  }
  for (const Attribute& attribute : list) read_attribute(attribute, mesh);
  const std::uint32_t length = mode == mode_lines ? 2u : static_cast<std::uint32_t>(order.size());
  mesh.triangles = fibre_pieces(std::vector<std::uint32_t>(order.size() / length, length));
  mesh.normal.clear();
  mesh.tangent.clear();
  take_order(mesh, order);
  const auto radius = std::ranges::find(mesh.primvars, "RADIUS", &Primvar::name);
  if (radius->components != 1) {
    primitive["attributes"]["_RADIUS"].error("a radius is one number", "a scalar accessor",
                                             fmt::format("{} components", radius->components));
    return false;
  }
  mesh.radius = std::move(radius->values);
  mesh.primvars.erase(radius);
  return true;
}

void GltfPrimitives::read_attribute(const Attribute& attribute, Mesh& mesh) {
  const std::string& semantic = attribute.semantic;
  const int n = attribute.accessor.components;
  const std::size_t count = attribute.accessor.count;
  std::vector<float> f = GltfAccessors::floats(attribute.accessor);
  const auto at = [&f, n](std::size_t i, int c) {
    return f[i * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)];
  };
  const auto bad = std::count_if(f.begin(), f.end(), [](float x) { return !std::isfinite(x); });
  // Of the others finish_mesh() tells what became of them.
  if (bad != 0 && semantic != "POSITION" && semantic != "NORMAL" && semantic != "TANGENT") {
    attribute.index.report().warning("bad-attribute", attribute.index.path(),
                                     "some values of an attribute are not finite", "finite numbers",
                                     fmt::format("{} that are not", bad));
  }
  for (std::size_t i = 0; i < count && semantic.starts_with("TEXCOORD_"); ++i) {
    f[i * static_cast<std::size_t>(n) + 1] = 1.f - at(i, 1);  // upper left to lower left
  }
  if (semantic == "POSITION") {
    mesh.position.reserve(count + 1);  // Embree reads it where it is: see bvh.cpp.
    for (std::size_t i = 0; i < count; ++i) mesh.position.push_back({at(i, 0), at(i, 1), at(i, 2)});
  } else if (semantic == "NORMAL") {
    mesh.normal.reserve(count);
    for (std::size_t i = 0; i < count; ++i) mesh.normal.push_back({at(i, 0), at(i, 1), at(i, 2)});
  } else if (semantic == "TANGENT") {
    mesh.tangent.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      mesh.tangent.push_back({{at(i, 0), at(i, 1), at(i, 2)}, at(i, 3)});
    }
  } else if (semantic == "TEXCOORD_0") {
    mesh.uv.reserve(count);
    for (std::size_t i = 0; i < count; ++i) mesh.uv.push_back({at(i, 0), at(i, 1)});
  } else {
    mesh.primvars.push_back({primvar_name(semantic), n, std::move(f)});
  }
}

}  // namespace nacre::host
