#pragma once

#include <nacre/nacre.h>

namespace nacre::api {

/// Another handle of the same shader, for who destroys the one that it holds.
nacre_shader* share(const nacre_shader* shader);

}  // namespace nacre::api
