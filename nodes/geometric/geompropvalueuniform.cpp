#include "runtime/node/node_call.h"

namespace nacre {

/// A uniform geometric property that is a text. MaterialX 1.39 Standard Nodes,
/// "geompropvalueuniform". Texts are known when a kernel is compiled and geometry
/// is not, so it is `default`. A text has no edges.
void record_geompropvalueuniform(NodeCall& call) { call.copy("default"); }

}  // namespace nacre
