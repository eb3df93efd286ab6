#pragma once

#include <functional>

#include "tests/pbs/independent/vector.h"

namespace nacre::reference {

/// Of f over the directions above: for lobes that are broad. To 1e-5.
double integral(const std::function<Scattered(Vec wi)>& lobe);

}  // namespace nacre::reference
