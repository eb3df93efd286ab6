#include "jit/api/python/placement.h"

#include <nanobind/stl/string.h>

#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "jit/api/python/array_view.h"
#include "jit/api/python/errors.h"

namespace nacre::python {

namespace nb = nanobind;

namespace {

constexpr std::ptrdiff_t number_bytes = 4;

std::string expected_shape(const ChannelUse& use) {
  if (use.is_scalar || use.most == 1) return "(count,)";
  if (use.least == use.most) return "(count, " + std::to_string(use.most) + ")";
  return "(count, " + std::to_string(use.least) + " or more)";
}

[[noreturn]] void refuse_array(const std::string& name, const std::string& message,
                               const std::string& expected, const ArrayView& view) {
  refuse("bad-array", name, "the array of '" + name + "' " + message, expected, view.text());
}

void check_numbers(const std::string& name, const ChannelUse& use, const ArrayView& view) {
  if (view.device != "cpu") refuse_array(name, "is not in this process's memory", "cpu", view);
  const bool is_float = use.type == NACRE_FLOAT;
  const bool fits =
      is_float ? view.type == "float32" : view.type == "int32" || view.type == "uint32";
  const char* const expected = is_float                ? "float32"
                               : use.type == NACRE_INT ? "int32 or uint32"
                                                       : "int32 that is 0 or 1";
  if (!fits) refuse_array(name, "has numbers of another type", expected, view);
  if (use.is_stored && view.is_read_only) {
    refuse_array(name, "is read-only, and the shader stores there", "one that can be written",
                 view);
  }
  bool is_aligned = reinterpret_cast<std::uintptr_t>(view.data) % number_bytes == 0;
  for (const std::ptrdiff_t stride : view.strides) {
    is_aligned = is_aligned && stride % number_bytes == 0;
  }
  if (!is_aligned) refuse_array(name, "is not aligned", "numbers at multiples of 4 bytes", view);
}

/// Axes that count components, from the last: 0, 1, or 2 for a matrix's rows and columns.
std::optional<std::size_t> component_axes(const ChannelUse& use, const ArrayView& view) {
  const std::size_t axes = view.shape.size();
  if (use.is_scalar) return 0;
  const auto fits = [&](std::ptrdiff_t size) { return use.least <= size && size <= use.most; };
  if (axes >= 1 && fits(view.shape[axes - 1])) return 1;
  const std::ptrdiff_t size = axes >= 2 ? view.shape[axes - 1] : 0;
  if (use.most > 4 && size == view.shape[axes - 2] && fits(size * size)) return 2;
  return use.most == 1 ? std::optional<std::size_t>(0) : std::nullopt;
}

/// Makes one axis of all but the last `components` axes.
void merge_points(const ArrayView& view, std::size_t components, const ChannelUse& use,
                  Placement& placement) {
  const std::size_t axes = view.shape.size() - components;
  if (axes == 0) return;
  std::uint64_t length = 1;
  std::ptrdiff_t stride = 0;
  bool is_regular = true;
  for (std::size_t i = axes; i-- > 0;) {
    const std::ptrdiff_t size = view.shape[i];
    if (size != 1) {
      const std::ptrdiff_t next = stride * static_cast<std::ptrdiff_t>(length);
      if (length != 1) is_regular = is_regular && view.strides[i] == next;
      if (length == 1) stride = view.strides[i];
      if (length == 1 && stride == 0 && use.is_stored) is_regular = false;
    }
    length *= static_cast<std::uint64_t>(size);
  }
  if (length > 1 && !is_regular) {
    refuse_array(placement.name, "has points that are not evenly spaced",
                 "one stride from each point to the next", view);
  }
  placement.length = length;
  placement.stride = length == 1 ? static_cast<std::ptrdiff_t>(number_bytes) : stride;
}

bool is_matrix(const std::string& name, const ChannelUse& use) {
  return use.most > 4 && name != "state";
}

/// Of a matrix, "m.0" to "m.15". They have to be bound one by one.
std::string component_name(const std::string& name, int component) {
  return name + '.' + std::to_string(component);
}

void bind_array(nacre_binder* binder, const std::string& name, const nacre_layout& layout) {
  detail::check(nacre_binder_array(binder, name.c_str(), &layout));
}

void place_array(nacre_binder* binder, std::vector<Placement>& placements, Placement placement,
                 const ChannelUse& use, ArrayView view) {
  check_numbers(placement.name, use, view);
  const std::optional<std::size_t> axes = component_axes(use, view);
  if (!axes) refuse_array(placement.name, "has another shape", expected_shape(use), view);
  merge_points(view, *axes, use, placement);
  placement.data = view.data;
  placement.holder = std::move(view.holder);

  const std::size_t last = view.shape.size();
  nacre_layout layout{};
  layout.size = sizeof layout;
  layout.array = static_cast<std::uint32_t>(placements.size());
  layout.element = placement.element;
  layout.stride = placement.stride;
  layout.component_stride = *axes > 0 ? view.strides[last - 1] : 0;
  bind_array(binder, placement.name, layout);
  const std::ptrdiff_t columns = *axes > 0 ? view.shape[last - 1] : 1;
  for (int i = 0; is_matrix(placement.name, use) && i < use.most; ++i) {
    layout.offset = view.strides[last - 1] * (i % columns);
    if (*axes == 2) layout.offset += view.strides[last - 2] * (i / columns);
    bind_array(binder, component_name(placement.name, i), layout);
  }
  placements.push_back(std::move(placement));
}

/// Nothing for what is neither a number nor a sequence of numbers.
std::optional<std::vector<double>> numbers_of(nb::handle object) {
  std::vector<double> numbers;
  const bool is_sequence = nb::isinstance<nb::tuple>(object) || nb::isinstance<nb::list>(object);
  const nb::object all = is_sequence ? nb::borrow(object) : nb::make_tuple(object);
  for (nb::handle each : all) {
    if (PyFloat_Check(each.ptr()) == 0 && PyLong_Check(each.ptr()) == 0) return std::nullopt;
    numbers.push_back(PyFloat_AsDouble(each.ptr()));
    if (PyErr_Occurred() != nullptr) nb::raise_python_error();
  }
  return numbers;
}

void place_constant(nacre_binder* binder, const std::string& name, const ChannelUse& use,
                    const std::vector<double>& numbers) {
  const auto count = static_cast<int>(numbers.size());
  const std::string found = std::to_string(count) + (count == 1 ? " number" : " numbers");
  if (count < use.least || count > use.most) {
    refuse("bad-array", name, "'" + name + "' has another number of components",
           std::to_string(use.least), found);
  }
  if (use.is_stored) {
    refuse("bad-array", name, "the shader stores '" + name + "'", "an array", found);
  }
  std::vector<std::uint32_t> bits;
  for (const double number : numbers) {
    std::uint32_t& to = bits.emplace_back();
    if (use.type == NACRE_FLOAT) {
      const auto value = static_cast<float>(number);
      std::memcpy(&to, &value, sizeof to);
      continue;
    }
    const bool is_whole = number >= -0x1p31 && number < 0x1p32 &&
                          number == static_cast<double>(static_cast<std::int64_t>(number));
    if (!is_whole) {
      refuse("bad-array", name, "'" + name + "' has numbers of another type", "int32",
             std::to_string(number));
    }
    to = static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
  }
  detail::check(nacre_binder_constant(binder, name.c_str(), bits.data(), bits.size()));
  for (int i = 0; is_matrix(name, use) && i < count; ++i) {
    const std::string component = component_name(name, i);
    detail::check(nacre_binder_constant(binder, component.c_str(), &bits[i], 1));
  }
}

}  // namespace

void place(nacre_binder* binder, std::vector<Placement>& placements, const std::string& name,
           int element, const ChannelUse& use, nb::handle object) {
  // First, for some numbers are arrays, too: of doubles, where the constant may be a float.
  if (const auto numbers = numbers_of(object)) return place_constant(binder, name, use, *numbers);
  if (std::optional<ArrayView> view = ArrayView::of(object)) {
    Placement placement;
    placement.name = name;
    placement.element = element;
    return place_array(binder, placements, std::move(placement), use, std::move(*view));
  }
  refuse("bad-array", name, "'" + name + "' is bound to what has no numbers",
         "an object with the buffer protocol or DLPack, a number, or a tuple of numbers",
         nb::cast<std::string>(object.type().attr("__name__")));
}

}  // namespace nacre::python
