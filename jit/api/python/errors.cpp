// What there is to say: Error as nacre.Error, warnings as Python's.
#include "jit/api/python/errors.h"

#include <exception>

#include "jit/api/python/module.h"

namespace nacre::python {

namespace nb = nanobind;

namespace {

nb::object errors_module() { return nb::module_::import_("nacre._errors"); }

nb::object as_python(const Diagnostic& one) {
  return errors_module().attr("Diagnostic")(
      one.severity, text(one.code), text(one.file), one.line, one.column, text(one.path),
      text(one.message), text(one.expected), text(one.found), text(one.text), text(one.hint));
}

void set_error(const Error& error) {
  try {
    const nb::list said = diagnostics_of(error.diagnostics());
    const nb::object type = errors_module().attr("Error");
    PyErr_SetObject(type.ptr(), type(said, error.status(), text(error.what())).ptr());
  } catch (nb::python_error& failure) {
    failure.restore();
  }
}

}  // namespace

nb::str text(std::string_view utf8) {
  PyObject* made =
      PyUnicode_DecodeUTF8(utf8.data(), static_cast<Py_ssize_t>(utf8.size()), "replace");
  if (made == nullptr) nb::raise_python_error();
  return nb::steal<nb::str>(made);
}

nb::list texts(const std::vector<std::string>& list) {
  nb::list made;
  for (const std::string& each : list) made.append(text(each));
  return made;
}

void refuse(const std::string& code, const std::string& name, const std::string& message,
            const std::string& expected, const std::string& found, const std::string& hint) {
  Diagnostic said;
  said.code = code;
  said.path = name;
  said.message = message;
  said.expected = expected;
  said.found = found;
  said.hint = hint;
  // As the library writes its own.
  said.text = "error: " + message;
  if (!expected.empty()) said.text += "; expected " + expected;
  if (!found.empty()) said.text += (expected.empty() ? "; found " : ", found ") + found;
  if (!hint.empty()) said.text += "; " + hint;
  said.text += " [" + code + "] (" + name + ")";
  throw Error(NACRE_WRONG_ARGUMENTS, {said});
}

std::string near_hint(const std::string& wanted, const std::vector<std::string>& known) {
  const nb::object near =
      nb::module_::import_("difflib").attr("get_close_matches")(text(wanted), texts(known), 1);
  if (nb::len(near) == 0) return "";
  return std::string("did you mean '") + nb::str(near[nb::int_(0)]).c_str() + "'?";
}

nb::list diagnostics_of(const std::vector<Diagnostic>& said) {
  nb::list made;
  for (const Diagnostic& one : said) made.append(as_python(one));
  return made;
}

void warn(const std::vector<Diagnostic>& said) {
  for (const Diagnostic& one : said) errors_module().attr("say")(as_python(one));
}

void bind_errors() {
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& error) {
      set_error(error);
    }
  });
}

}  // namespace nacre::python
