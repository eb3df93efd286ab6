#pragma once

#include <string_view>

#include "nodes/texture2d/sampler.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// Values of the enumerated inputs of `image`; an unknown one is reported and taken for
/// the nodedefs' default.
TextureFilter parse_filter(NodeCall& call, std::string_view input);
AddressMode parse_address_mode(NodeCall& call, std::string_view input);

/// What the node's input `file` (and `layer`, where it has one) stands for; nothing where
/// there are no textures.
TextureSources find_image(NodeCall& call);
/// No image at all: the node is its default everywhere.
bool is_missing(const TextureSources& sources);

/// An input of one to four components; those it lacks are 0.
Float4 widened(const Recorded& value);
/// Sets the first output to the components of `v` that its type has.
void set_components(NodeCall& call, const Float4& v);

}  // namespace nacre
