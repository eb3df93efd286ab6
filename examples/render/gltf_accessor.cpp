#include "examples/render/gltf_accessor.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>

namespace nacre::host {

namespace {

template <class T>
T read(const unsigned char* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

/// glTF 2.0, 3.6.2.3: the divisors are the largest value, and -128 clamps to -1.
float read_component(const unsigned char* p, int type, bool normalized) {
  const auto scale = [normalized](float v, float largest) {
    return normalized ? std::max(v / largest, -1.f) : v;
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return read<float>(p);
    case TINYGLTF_COMPONENT_TYPE_BYTE: return scale(read<std::int8_t>(p), 127.f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scale(read<std::uint8_t>(p), 255.f);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return scale(read<std::int16_t>(p), 32767.f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return scale(read<std::uint16_t>(p), 65535.f);
    default: return static_cast<float>(read<std::uint32_t>(p));
  }
}

}  // namespace

void GltfAccessors::error(int accessor, const char* message, std::string expected,
                          std::string found) {
  diagnostics_.error("bad-gltf", {file_, 0, 0, fmt::format("accessors[{}]", accessor)}, message,
                     std::move(expected), std::move(found));
}

GltfAccessors::View GltfAccessors::view(int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size()) {
    error(index, "there is no such accessor",
          fmt::format("an index below {}", model_.accessors.size()), fmt::format("{}", index));
    return {};
  }
  const tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(index)];
  if (a.sparse.isSparse) {
    error(index, "sparse accessors are not supported", "a dense accessor", "sparse");
    return {};
  }
  if (a.bufferView < 0 || static_cast<std::size_t>(a.bufferView) >= model_.bufferViews.size()) {
    error(index, "the accessor has no buffer view",
          fmt::format("an index below {}", model_.bufferViews.size()),
          fmt::format("{}", a.bufferView));
    return {};
  }
  const tinygltf::BufferView& bv = model_.bufferViews[static_cast<std::size_t>(a.bufferView)];
  if (bv.buffer < 0 || static_cast<std::size_t>(bv.buffer) >= model_.buffers.size()) {
    error(index, "the buffer view has no buffer",
          fmt::format("an index below {}", model_.buffers.size()), fmt::format("{}", bv.buffer));
    return {};
  }
  const std::vector<unsigned char>& data = model_.buffers[static_cast<std::size_t>(bv.buffer)].data;
  const int component_bytes =
      tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.componentType));
  const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type));
  if (component_bytes <= 0 || components <= 0) {
    error(index, "the accessor has no known type", "a glTF 2.0 component type and type",
          fmt::format("componentType {}, type {}", a.componentType, a.type));
    return {};
  }
  const std::size_t element = static_cast<std::size_t>(component_bytes * components);
  const std::size_t stride = bv.byteStride != 0 ? bv.byteStride : element;
  // In this order nothing overflows: sizes are compared by what is left.
  const bool view_fits =
      bv.byteOffset <= data.size() && bv.byteLength <= data.size() - bv.byteOffset;
  const bool starts = view_fits && a.byteOffset <= bv.byteLength &&
                      element <= bv.byteLength - a.byteOffset && stride >= element;
  if (a.count == 0 || !starts ||
      (a.count - 1) > (bv.byteLength - a.byteOffset - element) / stride) {
    error(index, "the accessor is not within its buffer",
          fmt::format("{} elements of {} bytes every {} bytes", a.count, element, stride),
          fmt::format("{} bytes from {}", bv.byteLength, a.byteOffset));
    return {};
  }
  return {data.data() + bv.byteOffset + a.byteOffset,
          a.count,
          stride,
          a.componentType,
          components,
          a.normalized};
}

std::vector<float> GltfAccessors::floats(int accessor, int min_components, int& components) {
  const View v = view(accessor);
  components = v.components;
  if (v.data == nullptr) return {};
  if (v.components < min_components || v.components > 4 ||
      v.component_type == TINYGLTF_COMPONENT_TYPE_DOUBLE) {
    error(accessor, "the accessor has another type than its attribute needs",
          fmt::format("{} to 4 components", min_components),
          fmt::format("{} of type {}", v.components, v.component_type));
    return {};
  }
  const auto bytes = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(v.component_type));
  std::vector<float> values(v.count * static_cast<std::size_t>(v.components));
  for (std::size_t i = 0; i < v.count; ++i) {
    for (int c = 0; c < v.components; ++c) {
      values[i * static_cast<std::size_t>(v.components) + static_cast<std::size_t>(c)] =
          read_component(v.data + i * v.stride + c * bytes, v.component_type, v.normalized);
    }
  }
  return values;
}

std::vector<std::uint32_t> GltfAccessors::indices(int accessor, bool& ok) {
  const View v = view(accessor);
  ok = v.data != nullptr;
  if (!ok) return {};
  std::vector<std::uint32_t> values(v.count);
  for (std::size_t i = 0; ok && i < v.count; ++i) {
    const unsigned char* p = v.data + i * v.stride;
    switch (v.component_type) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: values[i] = *p; break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: values[i] = read<std::uint16_t>(p); break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: values[i] = read<std::uint32_t>(p); break;
      default: ok = false;
    }
  }
  if (ok && v.components == 1) return values;
  ok = false;
  error(accessor, "the accessor cannot be indices", "scalar unsigned 8, 16 or 32 bit integers",
        fmt::format("{} components of type {}", v.components, v.component_type));
  return {};
}

}  // namespace nacre::host
