#include "jit/api/python/index_list.h"

#include <string>
#include <utility>

#include "jit/api/python/errors.h"

namespace nacre::python {

IndexList::IndexList(nanobind::handle object, const char* name) {
  if (object.is_none()) return;
  const std::string message = std::string("'") + name + "' is no list of elements";
  const char* const expected = "a contiguous array of uint32";
  std::optional<ArrayView> view = ArrayView::of(object);
  if (!view) {
    refuse("bad-array", name, message, expected, Py_TYPE(object.ptr())->tp_name);
  }
  const bool has_numbers = view->type == "uint32" || view->type == "int32";
  const bool is_dense = view->shape.size() == 1 && (view->strides[0] == 4 || view->shape[0] <= 1) &&
                        reinterpret_cast<std::uintptr_t>(view->data) % sizeof(std::uint32_t) == 0;
  if (!has_numbers || !is_dense || view->device != "cpu") {
    refuse("bad-array", name, message, expected, view->text());
  }
  is_given_ = true;
  size_ = static_cast<std::uint64_t>(view->shape[0]);
  data_ = reinterpret_cast<const std::uint32_t*>(view->data);
  view_ = std::move(*view);
}

}  // namespace nacre::python
