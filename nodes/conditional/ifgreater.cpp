#include "nodes/conditional/choose.h"

namespace nacre {

/// in1 where value1 > value2, else in2; false where either is NaN. MaterialX 1.39
/// Standard Nodes, "ifgreater".
void record_ifgreater(NodeCall& call) {
  if (call.type("value1") == Type::integer) {
    choose(call, call.integer("value1") > call.integer("value2"));
  } else {
    choose(call, call.number("value1") > call.number("value2"));
  }
}

}  // namespace nacre
