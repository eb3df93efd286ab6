// Values of a shader's parameters. Names and types are nacre/_parameters.py's business; here are
// the bytes.
#include <cstddef>
#include <vector>

#include "jit/api/python/errors.h"
#include "jit/api/python/module.h"

namespace nacre::python {

namespace nb = nanobind;

void bind_instance(nb::module_& module) {
  nb::class_<Instance>(module, "Instance")
      .def(nb::init<const Shader&>(), nb::arg("shader"))
      .def(
          "_get",
          [](const Instance& self, std::size_t parameter, std::size_t components) {
            std::vector<std::uint32_t> values(components);
            detail::check(nacre_instance_get(self.get(), parameter, values.data()));
            return nb::bytes(values.data(), 4 * components);
          },
          nb::arg("parameter"), nb::arg("components"))
      .def(
          "_set",
          [](const Instance& self, std::size_t parameter, const nb::bytes& values) {
            detail::check(nacre_instance_set(self.get(), parameter, values.c_str()));
          },
          nb::arg("parameter"), nb::arg("values"));
}

}  // namespace nacre::python
