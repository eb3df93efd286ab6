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

std::size_t GltfAccessors::Form::bytes() const {
  return component_bytes(static_cast<std::size_t>(type)) * static_cast<std::size_t>(components);
}

void GltfAccessors::give(std::size_t number, const Form& form, std::string bytes) {
  const std::string& kept = made_.emplace_back(std::move(bytes));
  given_[number] = {kept.data(), form.count, form.bytes(), form.type, form.components, false};
}

std::optional<GltfAccessors::Form> GltfAccessors::form(const GltfValue& a) const {
  const auto count = a["count"].need("a number of elements").count();
  const auto type = a["componentType"].need("a component type").count();
  const auto shape = a["type"].need("a type").text();
  if (!count || !type || !shape) return {};
  if (component_bytes(*type) == 0 || component_count(*shape) == 0) {
    a.error("the accessor has no known type", "a component type and type of glTF 2.0",
            fmt::format("componentType {}, type \"{}\"", *type, *shape));
    return {};
  }
  return Form{*count, static_cast<int>(*type), component_count(*shape)};
}

std::optional<GltfAccessor> GltfAccessors::open(const GltfValue& index) {
  const auto number = index.index_of(root_["accessors"]);
  if (!number) return {};
  const GltfValue a = root_["accessors"][*number];
  std::optional<GltfAccessor> result;
  if (const auto given = given_.find(*number); given != given_.end()) {
    result = given->second;
  } else if (const auto of = form(a)) {
    result = a["sparse"] ? sparse(a, *of) : elements(a, a["bufferView"], *of);
  }
  if (result) result->normalized = a["normalized"].boolean().value_or(false);
  return result;
}

/// Those of `view` that the accessor's byteOffset begins.
std::optional<GltfAccessor> GltfAccessors::elements(const GltfValue& a, const GltfValue& view,
                                                    const Form& form) {
  const auto data = buffers_.view(view);
  if (!data) return {};
  // What is there but wrong has been reported and counts as nothing until the end.
  const std::size_t offset = a["byteOffset"].count().value_or(0);
  const std::size_t element = form.bytes(), length = data->size();
  const GltfValue stride_of = root_["bufferViews"][*view.count()]["byteStride"];
  const std::size_t stride = stride_of.count().value_or(element);
  // In this order nothing overflows: sizes are compared by what is left.
  const bool starts = offset <= length && element <= length - offset && stride >= element;
  if (form.count == 0 || !starts || form.count - 1 > (length - offset - element) / stride) {
    a.error("the accessor is not within its buffer view",
            fmt::format("at least one element of {} bytes every {}, from {}, in {} bytes", element,
                        stride, offset, length),
            fmt::format("{} elements", form.count));
    return {};
  }
  return GltfAccessor{data->data() + offset, form.count, stride, form.type, form.components, false};
}

/// glTF 2.0, 3.6.2.4: zeros, or elements of a view, some of which are others.
std::optional<GltfAccessor> GltfAccessors::sparse(const GltfValue& a, const Form& form) {
  const GltfValue s = a["sparse"], at = s["indices"], by = s["values"];
  const auto count = s["count"].need("a number of elements").count();
  const auto type = at["componentType"].need("a component type").count();
  if (!count || !type) return {};
  const bool is_unsigned = *type == type_u8 || *type == type_u16 || *type == type_u32;
  if (!is_unsigned || *count > form.count || form.count == 0) {
    s.error("the sparse accessor has another form",
            fmt::format("unsigned integers as indices, at most {}", form.count),
            fmt::format("{} of component type {}", *count, *type));
    return {};
  }
  std::optional<GltfAccessor> base;
  if (a["bufferView"] && !(base = elements(a, a["bufferView"], form))) return {};
  const Form index{*count, static_cast<int>(*type), 1}, value{*count, form.type, form.components};
  std::optional<GltfAccessor> places, values;
  if (*count != 0) {
    places = elements(at, at["bufferView"], index);
    values = elements(by, by["bufferView"], value);
    if (!places || !values) return {};
  }
  const std::size_t element = form.bytes();
  // A count is any number that the file says.
  constexpr std::size_t most = std::size_t{1} << 40;
  const std::size_t size = form.count > most ? most : form.count * element;
  if (!budget_.take_bytes(a.location(), size)) return {};
  std::string& bytes = made_.emplace_back(form.count * element, '\0');
  for (std::size_t i = 0; base && i < form.count; ++i) {
    std::memcpy(&bytes[i * element], base->data + i * base->stride, element);
  }
  const std::vector<std::uint32_t> order =
      places ? integers(*places) : std::vector<std::uint32_t>();
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] >= form.count) {
      at.error("an index of the sparse accessor is out of range",
               fmt::format("less than {}", form.count), fmt::format("{}", order[i]));
      return {};
    }
    std::memcpy(&bytes[order[i] * element], values->data + i * values->stride, element);
  }
  return GltfAccessor{bytes.data(), form.count, element, form.type, form.components, false};
}

std::optional<GltfAccessor> GltfAccessors::matrices(const GltfValue& index) {
  const auto a = open(index);
  if (!a) return {};
  if (a->components == 16 && a->component_type == type_f32) return a;
  index.error("the accessor is no list of matrices", "MAT4 of floats",
              fmt::format("{} components of type {}", a->components, a->component_type));
  return {};
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

std::optional<GltfAccessor> GltfAccessors::joints(const GltfValue& index) {
  const auto a = open(index);
  if (!a) return {};
  const bool is_unsigned = a->component_type == type_u8 || a->component_type == type_u16;
  if (is_unsigned && a->components == 4) return a;
  index.error("the accessor cannot be joints", "four unsigned 8 or 16 bit integers",
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
  const auto components = static_cast<std::size_t>(a.components);
  const std::size_t bytes = component_bytes(static_cast<std::size_t>(a.component_type));
  std::vector<std::uint32_t> values(a.count * components);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* p = a.data + i / components * a.stride + i % components * bytes;
    switch (a.component_type) {
      case type_u8: values[i] = read<std::uint8_t>(p); break;
      case type_u16: values[i] = read<std::uint16_t>(p); break;
      default: values[i] = read<std::uint32_t>(p);
    }
  }
  return values;
}

}  // namespace nacre::host
