#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "examples/render/shader.h"

namespace nacre::host {

/// Where a batch has what an input channel of a kernel is.
using BatchSource = std::function<const void*(const ShadingBatch&)>;

/// That of a channel by its name in runtime/node/geometry.h; `needs` gets what has to be filled in
/// for it. What is no standard channel is a vertex attribute. A name without a component is the
/// presence of a geometric property ("geomprop.wear": it comes with each point, see
/// varying_slots()), a matrix's entry, or nothing, and the result is empty.
BatchSource batch_channel(std::string_view name, Capabilities& needs);

/// The host's name of a vertex attribute: "uv1" is "texcoord1", "geomprop.foo" "foo".
std::string primvar_name(std::string_view group);

/// Which of `needs.primvars` it is, with as many components at least.
int request_primvar(std::string_view name, int components, Capabilities& needs);

}  // namespace nacre::host
