#pragma once

#include <nanobind/nanobind.h>

#include <nacre/nacre.hpp>

namespace nacre::python {

/// Python's function (name, named_by, is_image) -> None | str | os.PathLike | bytes, as a hook that
/// any thread may call and destroy; of None no hook. Where the function raises, or returns anything
/// else, there is no such file: the diagnostic of that has the reason in place of its path.
/// Throws TypeError for what cannot be called.
FileResolver resolver_of(const nanobind::object& function);

}  // namespace nacre::python
