// nacre._core: <nacre/nacre.hpp> for Python. What users see is in nacre/*.py, on top of this.
#include "jit/api/python/module.h"

#include <nacre/nacre.hpp>

namespace nb = nanobind;
using namespace nacre::python;

NB_MODULE(_core, module) {
  // A library that prints nothing, at the interpreter's end neither.
  nb::set_leak_warnings(false);
  module.attr("version") = nacre_version_text();
  module.def(
      "data_library", [] { return nacre_data_library(); },
      "The folder of the MaterialX data library that came with nacre; '' if it is not there.");
  bind_errors();
  bind_document(module);
  bind_shader(module);
  bind_instance(module);
  bind_system(module);
  bind_binding(module);
}
