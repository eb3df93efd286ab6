#pragma once

#include "examples/image_input/opened_graph.h"

namespace graph_image {

/// What nacre_graphs.so gives: all that needs libnacre. OpenImageIO loads every plug-in with the
/// first image that a program reads, whatever that is, so the plug-in itself needs nothing but
/// OpenImageIO, and this is loaded by the first graph.
struct GraphModule {
  const char* build;  ///< What both were built with: NACRE_BUILD_KEY.
  OpenGraph* open;
};

/// Opens by the module, which lies in the folder above that of the plug-in. Throws Wrong where it
/// is not there, cannot be loaded or is of another build.
OpenGraph open_by_module;

}  // namespace graph_image
