#include "examples/render/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

namespace nacre::host {

namespace {

/// glTF 2.0, 3.6.2.2.
enum ComponentType : int {
  type_i8 = 5120,
  type_u8 = 5121,
  type_i16 = 5122,
  type_u16 = 5123,
  type_u32 = 5125,
  type_f32 = 5126,
};

std::size_t component_bytes(std::size_t type) {
  switch (type) {
    case type_i8:
    case type_u8: return 1;
    case type_i16:
    case type_u16: return 2;
    case type_u32:
    case type_f32: return 4;
    default: return 0;
  }
}

int component_count(std::string_view type) {
  constexpr std::pair<std::string_view, int> types[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, count] : types) {
    if (name == type) return count;
  }
  return 0;
}

template <class T>
T read(const char* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

/// glTF 2.0, 3.6.2.3: the divisors are the largest value, and -128 clamps to -1.
float read_component(const char* p, int type, bool normalized) {
  const auto scale = [normalized](float v, float largest) {
    return normalized ? std::max(v / largest, -1.f) : v;
  };
  switch (type) {
    case type_f32: return read<float>(p);
    case type_i8: return scale(read<std::int8_t>(p), 127.f);
    case type_u8: return scale(read<std::uint8_t>(p), 255.f);
    case type_i16: return scale(read<std::int16_t>(p), 32767.f);
    case type_u16: return scale(read<std::uint16_t>(p), 65535.f);
    default: return static_cast<float>(read<std::uint32_t>(p));
  }
}

}  // namespace

std::optional<GltfAccessor> GltfAccessors::open(const GltfValue& index) {
  const auto number = index.index_of(root_["accessors"]);
  if (!number) return {};
  const GltfValue a = root_["accessors"][*number];
  if (a["sparse"]) {
    a.error("sparse accessors are not supported", "a dense accessor", "sparse");
    return {};
  }
  const auto view_index = a["bufferView"].need("the index of a buffer view");
  const auto view_number = view_index.index_of(root_["bufferViews"]);
  const auto count = a["count"].need("a number of elements").count();
  const auto type = a["componentType"].need("a component type").count();
  const auto shape = a["type"].need("a type").text();
  if (!view_number || !count || !type || !shape) return {};
  const GltfValue view = root_["bufferViews"][*view_number];
  const auto buffer = view["buffer"].need("the index of a buffer").index_of(root_["buffers"]);
  const auto length = view["byteLength"].need("a length in bytes").count();
  if (!buffer || !length) return {};
  const std::size_t bytes = component_bytes(*type);
  const int components = component_count(*shape);
  if (bytes == 0 || components == 0) {
    a.error("the accessor has no known type", "a component type and type of glTF 2.0",
            fmt::format("componentType {}, type \"{}\"", *type, *shape));
    return {};
  }
  // What is there but wrong has been reported and counts as nothing until the end.
  const std::size_t view_offset = view["byteOffset"].count().value_or(0);
  const std::size_t offset = a["byteOffset"].count().value_or(0);
  const std::size_t element = bytes * static_cast<std::size_t>(components);
  const std::size_t stride = view["byteStride"].count().value_or(element);
  const auto data = buffers_.bytes(*buffer);
  if (!data) return {};
  if (view_offset > data->size() || *length > data->size() - view_offset) {
    view.error("the buffer view is not within its buffer",
               fmt::format("at most {} bytes", data->size()),
               fmt::format("{} bytes from {}", *length, view_offset));
    return {};
  }
  // In this order nothing overflows: sizes are compared by what is left.
  const bool starts = offset <= *length && element <= *length - offset && stride >= element;
  if (*count == 0 || !starts || *count - 1 > (*length - offset - element) / stride) {
    a.error("the accessor is not within its buffer view",
            fmt::format("at least one element of {} bytes every {}, from {}, in {} bytes", element,
                        stride, offset, *length),
            fmt::format("{} elements", *count));
    return {};
  }
  return GltfAccessor{
      data->data() + view_offset + offset,      *count, stride, static_cast<int>(*type), components,
      a["normalized"].boolean().value_or(false)};
}

std::optional<GltfAccessor> GltfAccessors::attribute(const GltfValue& index, int least) {
  const auto a = open(index);
  if (!a) return {};
  if (a->components >= least && a->components <= 4) return a;
  index.error("the accessor has another type than its attribute needs",
              fmt::format("{} to 4 components", least), fmt::format("{}", a->components));
  return {};
}

std::optional<GltfAccessor> GltfAccessors::indices(const GltfValue& index) {
  const auto a = open(index);
  if (!a) return {};
  const bool is_unsigned = a->component_type == type_u8 || a->component_type == type_u16 ||
                           a->component_type == type_u32;
  if (is_unsigned && a->components == 1) return a;
  index.error("the accessor cannot be indices", "scalar unsigned 8, 16 or 32 bit integers",
              fmt::format("{} components of type {}", a->components, a->component_type));
  return {};
}

std::vector<float> GltfAccessors::floats(const GltfAccessor& a) {
  const auto components = static_cast<std::size_t>(a.components);
  const std::size_t bytes = component_bytes(static_cast<std::size_t>(a.component_type));
  std::vector<float> values(a.count * components);
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t c = 0; c < components; ++c) {
      values[i * components + c] =
          read_component(a.data + i * a.stride + c * bytes, a.component_type, a.normalized);
    }
  }
  return values;
}

std::vector<std::uint32_t> GltfAccessors::integers(const GltfAccessor& a) {
  std::vector<std::uint32_t> values(a.count);
  for (std::size_t i = 0; i < a.count; ++i) {
    const char* p = a.data + i * a.stride;
    switch (a.component_type) {
      case type_u8: values[i] = read<std::uint8_t>(p); break;
      case type_u16: values[i] = read<std::uint16_t>(p); break;
      default: values[i] = read<std::uint32_t>(p);
    }
  }
  return values;
}

}  // namespace nacre::host
