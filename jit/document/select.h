#pragma once

#include "jit/document/definitions.h"
#include "jit/document/element.h"
#include "runtime/diagnostic.h"
#include "runtime/type.h"

namespace nacre {

/// The nodedef of a node instance. An explicit `nodedef` decides, even if it is
/// that of another category (the library has such an instance); otherwise the
/// first candidate, those of the namespace-qualified category before those of
/// the plain one, library before document, in document order, whose target is
/// ours, whose version agrees, whose output type is the instance's type, and
/// which has every input of the instance with the same type (Node::getNodeDef of
/// the reference). Null if there is none: then `diagnostics` says why.
///
/// With `stands_for`, where there is none for an instance whose category, version and output
/// type agree: the first that disagrees in the fewest inputs, each with a warning. It may
/// lack inputs, and others may have a type for which stands_for(instance's, nodedef's) holds.
const NodeDef* find_nodedef(const Element& instance, const Definitions& definitions,
                            Diagnostics& diagnostics,
                            bool (*stands_for)(Type from, Type to) = nullptr);

/// False for the structural elements of the format: "nodegraph", "input", "look", ...
bool is_node_category(std::string_view category);

/// True for the nodes that a material begins at: their inputs are its shaders.
bool is_material_category(std::string_view category);

/// True for elements that are instances of nodes: children of a document or
/// node graph that are none of the structural elements of the format.
bool is_node(const Element& element);

}  // namespace nacre
