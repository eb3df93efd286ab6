#pragma once

#include <nanobind/nanobind.h>

namespace nacre::python {

/// Each adds what its file is named for to the module nacre._core.
void bind_binding(nanobind::module_& module);
void bind_document(nanobind::module_& module);
void bind_errors();
void bind_instance(nanobind::module_& module);
void bind_shader(nanobind::module_& module);
void bind_system(nanobind::module_& module);

}  // namespace nacre::python
