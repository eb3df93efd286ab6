#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// An element and what it inherits from, nearest first. `base_of` an element is what that
/// inherits from, or null where the chain ends; it says itself what does not exist. Ends
/// before what was there already (inherit-cycle) and after Document::max_inheritance()
/// (inherit-depth), with an error that calls the element `what`, as in "node".
std::vector<const Element*> inheritance_chain(
    const Element& element, std::string_view what,
    const std::function<const Element*(const Element& heir)>& base_of, Diagnostics& diagnostics);

/// The chain of a node, whose instances inherit inputs from nodes of their category and
/// scope (Specification, "Shader Nodes"); an error, unknown-nodename too, says what is
/// wrong with it.
std::vector<const Element*> node_inheritance(const Element& node, Diagnostics& diagnostics);

/// What says something about an input of a node: its own <input>, or that of the nearest node
/// it inherits from which does. Null where none does: the nodedef's default stays.
const Element* find_input(const Element& node, std::string_view name);

/// All of those, a node's own before what it inherits; an error says what is wrong with what
/// it inherits from.
std::vector<const Element*> find_inputs(const Element& node, Diagnostics& diagnostics);

}  // namespace nacre
