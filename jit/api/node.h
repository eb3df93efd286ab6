#pragma once

#include <nacre/nacre.h>

#include "jit/shading/shading_system.h"

namespace nacre::api {

/// A host's body as the library has bodies.
HostBody host_body(const nacre_body& body);

}  // namespace nacre::api
