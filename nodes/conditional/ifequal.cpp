#include "nodes/conditional/choose.h"

namespace nacre {

/// in1 where value1 equals value2, else in2; NaN equals nothing. MaterialX 1.39
/// Standard Nodes, "ifequal".
void record_ifequal(NodeCall& call) {
  switch (call.type("value1")) {
    case Type::boolean: return choose(call, !(call.boolean("value1") ^ call.boolean("value2")));
    case Type::integer: return choose(call, call.integer("value1") == call.integer("value2"));
    default: return choose(call, call.number("value1") == call.number("value2"));
  }
}

}  // namespace nacre
