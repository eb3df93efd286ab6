#pragma once

#include "examples/measure/kernel_run.h"

namespace nacre::bench {

using measure::batch_points;
using measure::Columns;
using measure::KernelRun;

}  // namespace nacre::bench
