// Where files are, by a function of Python's.
#include "jit/api/python/resolver.h"

#include <memory>
#include <optional>
#include <string>

#include "jit/api/python/errors.h"

namespace nacre::python {

namespace nb = nanobind;

namespace {

File file_of(const std::string& name, const nb::handle& found) {
  if (PyBytes_Check(found.ptr())) {
    return {name, std::string(PyBytes_AsString(found.ptr()),
                              static_cast<std::size_t>(PyBytes_Size(found.ptr())))};
  }
  PyObject* encoded = nullptr;  // Of a str or os.PathLike.
  if (PyUnicode_FSConverter(found.ptr(), &encoded) == 0) nb::raise_python_error();
  const nb::object path = nb::steal(encoded);
  return {PyBytes_AsString(path.ptr()), std::nullopt};
}

/// A path that nothing is at.
File no_file(const nb::python_error& raised) {
  const nb::str reason(raised.value());
  return {std::string("(the resolver raised ") +
              nb::borrow<nb::str>(raised.type().attr("__name__")).c_str() + ": " + reason.c_str() +
              ')',
          std::nullopt};
}

}  // namespace

FileResolver resolver_of(const nb::object& function) {
  if (function.is_none()) return {};
  if (PyCallable_Check(function.ptr()) == 0) throw nb::type_error("resolver takes a function");
  const auto destroy = [](PyObject* held) {
    if (!nb::is_alive()) return;  // The interpreter has ended, and its objects with it.
    const nb::gil_scoped_acquire held_by_us;
    Py_DECREF(held);
  };
  const std::shared_ptr<PyObject> held(function.inc_ref().ptr(), destroy);
  return [held](const std::string& name, const std::string& named_by,
                int what) -> std::optional<File> {
    const nb::gil_scoped_acquire held_by_us;
    try {
      const nb::object found =
          nb::handle(held.get())(text(name), text(named_by), what == NACRE_IMAGE);
      if (found.is_none()) return std::nullopt;
      return file_of(name, found);
    } catch (const nb::python_error& raised) {
      return no_file(raised);
    }
  };
}

}  // namespace nacre::python
