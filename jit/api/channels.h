#pragma once

#include <nacre/nacre.h>

#include <cstdint>
#include <span>

#include "runtime/program/program.h"

namespace nacre::api {

/// NACRE_FLOAT, NACRE_INT or NACRE_BOOL.
int number_type(Scalar type);

/// Which list of a kernel a channel is in: names of outputs of node graphs are the document's own,
/// and may be those of channels.
enum class ChannelList { inputs, results_of_material, results_of_outputs };

/// What a host is told of a channel of a kernel. `state`: MaterialKernels::state. An input that is
/// in no table is a varying parameter.
nacre_channel channel_info(const Channel& channel, std::span<const std::uint32_t> state,
                           ChannelList list);

}  // namespace nacre::api
