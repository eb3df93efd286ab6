#pragma once

#include "examples/image_input/opened_graph.h"

namespace graph_image {

/// Opens an output of the store that all of the process share.
OpenGraph open_graph;

}  // namespace graph_image
