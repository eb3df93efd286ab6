#pragma once

#include <nacre/nacre.h>

#include "jit/api/recording.h"
#include "runtime/node/node_call.h"

namespace nacre::api {

/// NACRE_STANDARD and so on.
int accuracy_number(Accuracy accuracy);

/// Sets a node's output to a lobe whose functions are a host's.
void set_host_lobe(NodeCall& call, const nacre_lobe& lobe, Recording& recording);

}  // namespace nacre::api
