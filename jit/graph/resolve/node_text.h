#pragma once

#include "jit/document/nodedef.h"
#include "jit/graph/graph.h"

namespace nacre {

/// Whether its only output is a BSDF.
bool is_lobe(const NodeDef& def);

/// Whether an input of its names a file.
bool reads_image(const NodeDef& def);

/// Whether a text may implement the nodedef: it computes numbers and nothing else, or it is a
/// lobe. Other closures, and shaders, are none.
bool may_be_text(const NodeDef& def);

/// The implementation by text of a nodedef that an <implementation> element
/// gives: see Definitions::text_of.
NodeText node_text(const NodeDef& def, const Element& implementation);

}  // namespace nacre
