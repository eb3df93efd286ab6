#include "examples/render/gltf_draco.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

namespace nacre::host {

namespace {

template <class T>
bool copy_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components,
                 std::string& bytes) {
  bytes.resize(mesh.num_points() * static_cast<std::size_t>(components) * sizeof(T));
  std::vector<T> value(static_cast<std::size_t>(components));
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    const auto from = attribute.mapped_index(draco::PointIndex(i));
    if (!attribute.ConvertValue(from, static_cast<std::int8_t>(components), value.data()))
      return false;
    std::memcpy(&bytes[i * value.size() * sizeof(T)], value.data(), value.size() * sizeof(T));
  }
  return true;
}

/// As the accessor's type has them (glTF 2.0, 3.6.2.2).
bool copy_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int type,
                 int components, std::string& bytes) {
  switch (type) {
    case 5120: return copy_values<std::int8_t>(mesh, attribute, components, bytes);
    case 5121: return copy_values<std::uint8_t>(mesh, attribute, components, bytes);
    case 5122: return copy_values<std::int16_t>(mesh, attribute, components, bytes);
    case 5123: return copy_values<std::uint16_t>(mesh, attribute, components, bytes);
    case 5125: return copy_values<std::uint32_t>(mesh, attribute, components, bytes);
    default: return copy_values<float>(mesh, attribute, components, bytes);
  }
}

std::string corners(const draco::Mesh& mesh) {
  std::string bytes(mesh.num_faces() * 3 * sizeof(std::uint32_t), '\0');
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = face[static_cast<int>(c)].value();
      std::memcpy(&bytes[(3 * i + c) * sizeof v], &v, sizeof v);
    }
  }
  return bytes;
}

/// A number of 7 bits a byte, the low ones first; the bytes that it took are removed.
std::optional<std::uint64_t> varint(std::string_view& bytes) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 35 && !bytes.empty(); shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes.front());
    bytes.remove_prefix(1);
    value |= std::uint64_t{byte & 0x7fu} << shift;
    if (byte < 0x80) return value;
  }
  return {};
}

/// Faces and points that a stream says it has, whichever are more: the decoder takes memory for
/// them before it has looked for them. Nothing if it is of no version that says so.
/// Draco 3D Graphics Compression bitstream 2.2, "Header" and "Connectivity Decoder".
std::optional<std::uint64_t> declared_elements(std::string_view bytes) {
  constexpr std::size_t header = 11;
  constexpr char mesh = 1, edgebreaker = 1;
  if (bytes.size() <= header || !bytes.starts_with("DRACO") || bytes[7] != mesh) return {};
  const int version = 256 * bytes[5] + bytes[6];
  const bool is_edgebreaker = bytes[8] == edgebreaker;
  // A flag says that metadata comes first, which glTF has no use for.
  if (version < 0x202 || (static_cast<unsigned char>(bytes[10]) & 0x80u) != 0) return {};
  bytes.remove_prefix(is_edgebreaker ? header + 1 : header);
  const auto first = varint(bytes), second = varint(bytes);
  if (!first || !second) return {};
  return std::max(*first, *second);
}

}  // namespace

bool unpack_draco(const GltfValue& root, const GltfValue& primitive, GltfBuffers& buffers,
                  GltfAccessors& accessors, SceneBudget& budget) {
  const GltfValue extension = primitive["extensions"]["KHR_draco_mesh_compression"];
  if (!extension) return true;
  const auto packed = buffers.view(extension["bufferView"]);
  if (!packed) return false;
  const SourceLocation where = extension.location();
  const auto declared = declared_elements(*packed);
  if (!declared) {
    extension.error("the compressed mesh cannot be unpacked",
                    "a mesh of Draco's bitstream 2.2 without metadata",
                    fmt::format("{} bytes", packed->size()));
    return false;
  }
  // Of connectivity, in the decoder: three corners of a face with what is opposite.
  constexpr std::size_t bytes_of_face = 40;
  if (!budget.take_bytes(where, bytes_of_face * *declared)) return false;
  draco::DecoderBuffer buffer;
  buffer.Init(packed->data(), packed->size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    extension.error("the compressed mesh cannot be unpacked", "a mesh of Draco's",
                    decoded.status().error_msg());
    return false;
  }
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  const GltfValue names = extension["attributes"];
  for (const std::string& name : names.names()) {
    const auto id = names[name.c_str()].count();
    const GltfValue index = primitive["attributes"][name.c_str()];
    const auto number = index.need("the index of an accessor").index_of(root["accessors"]);
    if (!id || !number) return false;
    const auto* attribute = mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(*id));
    if (attribute == nullptr) {
      names[name.c_str()].error("the compressed mesh has no such attribute", "the number of one",
                                names[name.c_str()].shown());
      return false;
    }
    const auto form = accessors.form(root["accessors"][*number]);
    if (!form) return false;
    std::string bytes;
    if (!budget.take_bytes(where, mesh->num_points() * form->bytes())) return false;
    if (!copy_values(*mesh, *attribute, form->type, form->components, bytes)) {
      index.error("an attribute of the compressed mesh has another type", "that of its accessor",
                  name);
      return false;
    }
    accessors.give(*number, {mesh->num_points(), form->type, form->components}, std::move(bytes));
  }
  const GltfValue indices = primitive["indices"];
  const auto number = indices.index_of(root["accessors"]);
  if (!indices) return true;
  if (!number || !budget.take_bytes(where, std::size_t{12} * mesh->num_faces())) return false;
  constexpr int type_u32 = 5125;
  accessors.give(*number, {std::size_t{3} * mesh->num_faces(), type_u32, 1}, corners(*mesh));
  return true;
}

}  // namespace nacre::host
