#pragma once

#include <nacre/report.h>

#include "runtime/kernel.h"

namespace nacre::api {

inline nacre_status status_of(RunStatus status) {
  switch (status) {
    case RunStatus::done: return NACRE_OK;
    case RunStatus::stopped: return NACRE_STOPPED;
    case RunStatus::too_many_steps: return NACRE_TOO_MANY_STEPS;
    case RunStatus::wrong_arguments: return NACRE_WRONG_ARGUMENTS;
  }
  return NACRE_FAILED;
}

}  // namespace nacre::api
