#include "jit/api/python/array_view.h"

#include <nanobind/ndarray.h>

#include <cstring>

namespace nacre::python {

namespace nb = nanobind;

namespace {

/// Of a format of Python's struct module, in this machine's order; `format` itself where it is
/// none of one number.
std::string type_of_format(const std::string& format, std::ptrdiff_t bytes) {
  const bool has_order = !format.empty() && std::strchr("@=<", format.front()) != nullptr;
  const std::string code = has_order ? format.substr(1) : format;
  if (code.size() != 1) return format;
  const std::string bits = std::to_string(8 * bytes);
  if (std::strchr("efdg", code[0]) != nullptr) return "float" + bits;
  if (std::strchr("bhilqn", code[0]) != nullptr) return "int" + bits;
  if (std::strchr("BHILQN", code[0]) != nullptr) return "uint" + bits;
  return code == "?" ? "bool" : format;
}

std::string type_of_dlpack(nb::dlpack::dtype type) {
  const std::string bits = std::to_string(type.bits * type.lanes);
  switch (static_cast<nb::dlpack::dtype_code>(type.code)) {
    case nb::dlpack::dtype_code::Int: return "int" + bits;
    case nb::dlpack::dtype_code::UInt: return "uint" + bits;
    case nb::dlpack::dtype_code::Float: return "float" + bits;
    case nb::dlpack::dtype_code::Bfloat: return "bfloat" + bits;
    case nb::dlpack::dtype_code::Complex: return "complex" + bits;
    case nb::dlpack::dtype_code::Bool: return "bool";
    default: return "type " + std::to_string(type.code) + " of " + bits + " bits";
  }
}

std::string device_of_dlpack(int type) {
  switch (type) {
    case nb::device::cpu::value: return "cpu";
    case nb::device::cuda::value: return "cuda";
    case nb::device::metal::value: return "metal";
    case nb::device::rocm::value: return "rocm";
    default: return "device " + std::to_string(type);
  }
}

std::optional<ArrayView> of_buffer(nb::handle object) {
  if (PyObject_CheckBuffer(object.ptr()) == 0) return std::nullopt;
  auto buffer = std::make_unique<Py_buffer>();
  if (PyObject_GetBuffer(object.ptr(), buffer.get(), PyBUF_RECORDS_RO) != 0) {
    PyErr_Clear();  // DLPack may know more.
    return std::nullopt;
  }
  ArrayView view;
  view.data = static_cast<std::byte*>(buffer->buf);
  view.type = type_of_format(buffer->format != nullptr ? buffer->format : "B", buffer->itemsize);
  view.device = "cpu";
  view.is_read_only = buffer->readonly != 0;
  view.shape.assign(buffer->shape, buffer->shape + buffer->ndim);
  if (buffer->strides != nullptr) {
    view.strides.assign(buffer->strides, buffer->strides + buffer->ndim);
  } else {  // Those of ctypes say nothing: they are packed.
    view.strides.assign(view.shape.size(), buffer->itemsize);
    for (std::size_t i = view.shape.size(); i-- > 1;) {
      view.strides[i - 1] = view.strides[i] * view.shape[i];
    }
  }
  view.holder = std::shared_ptr<void>(buffer.release(), [](void* held) {
    auto* const released = static_cast<Py_buffer*>(held);
    PyBuffer_Release(released);
    delete released;
  });
  return view;
}

std::optional<ArrayView> of_dlpack(nb::handle object) {
  nb::ndarray<nb::ro> array;
  if (!nb::hasattr(object, "__dlpack__") || !nb::try_cast(object, array, false)) {
    return std::nullopt;
  }
  nb::ndarray<> written;
  ArrayView view;
  view.data = static_cast<std::byte*>(const_cast<void*>(array.data_handle())) + array.byte_offset();
  view.type = type_of_dlpack(array.dtype());
  view.device = device_of_dlpack(array.device_type());
  view.is_read_only = !nb::try_cast(object, written, false);
  for (std::size_t i = 0; i < array.ndim(); ++i) {
    view.shape.push_back(static_cast<std::ptrdiff_t>(array.shape(i)));
    view.strides.push_back(array.stride(i) * static_cast<std::ptrdiff_t>(array.itemsize()));
  }
  view.holder = std::make_shared<nb::ndarray<nb::ro>>(std::move(array));
  return view;
}

}  // namespace

std::optional<ArrayView> ArrayView::of(nb::handle object) {
  std::optional<ArrayView> view = of_buffer(object);
  return view ? view : of_dlpack(object);
}

std::string ArrayView::text() const {
  return type + ' ' + shape_text(shape) + (device == "cpu" ? "" : " on " + device) +
         (is_read_only ? ", read-only" : "");
}

std::string shape_text(const std::vector<std::ptrdiff_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (i > 0) text += ", ";
    text += std::to_string(shape[i]);
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

}  // namespace nacre::python
