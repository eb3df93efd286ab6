#pragma once

#include "jit/document/element.h"

namespace nacre::tool {

/// The port that says what an input is: the input itself, or, where it names an
/// interface of the graph around it, that graph's input. Null if there is none.
const Element* bound_port(const Element& input);

/// True if a port is connected.
bool is_connected(const Element& port);

/// The <output> of a graph that a port names, or null.
const Element* output_of(const Element& port);

/// The node that a port leads to, through outputs of graphs; null if there is none.
const Element* source_node(const Element& port);

/// The graph or document in which a port's names are looked up.
const Element& scope_of(const Element& port);

}  // namespace nacre::tool
