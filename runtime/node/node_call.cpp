#include "runtime/node/node_call.h"

#include <string>
#include <utility>

namespace nacre {

NodeCall::NodeCall(Recorder& recorder, std::string_view category, std::string_view nodedef,
                   std::vector<Port> inputs, std::vector<Port> outputs, Accuracy accuracy,
                   TextureProvider* textures, Diagnostics& diagnostics, SourceLocation where)
    : recorder_(recorder),
      category_(category),
      nodedef_(nodedef),
      inputs_(std::move(inputs)),
      outputs_(std::move(outputs)),
      accuracy_(accuracy),
      textures_(textures),
      diagnostics_(diagnostics),
      where_(std::move(where)) {}

bool NodeCall::has(std::string_view name) const {
  for (const Port& port : inputs_) {
    if (port.name == name) return true;
  }
  return false;
}

namespace {

/// What a body gets that asks for a port its nodedef does not have: a host's, or one
/// of ours with a Graph made by hand. The error keeps the kernel from being made.
void report_misfit(Diagnostics& diagnostics, const NodeCall& call, std::string_view port,
                   std::string expected) {
  diagnostics.error("port-mismatch", call.where(),
                    "the body of '" + std::string(call.nodedef()) +
                        "' asks for a port that its nodedef does not have",
                    std::move(expected), "'" + std::string(port) + "'");
}

Ref part_of(const NodeCall& call, Diagnostics& diagnostics, std::string_view name, std::size_t i,
            Scalar scalar) {
  const Recorded& value = call.in(name);
  if (i < value.parts.size() && value.parts[i].type == scalar) return value.parts[i];
  // Of a port that is not there `in` has complained.
  if (call.has(name)) report_misfit(diagnostics, call, name, std::string(scalar_name(scalar)));
  return {nullptr, 0, scalar};
}

}  // namespace

const Recorded& NodeCall::in(std::string_view name) const {
  for (const Port& port : inputs_) {
    if (port.name == name) return port.value;
  }
  report_misfit(diagnostics_, *this, name, "the name of an input");
  // As many parts as any type has, for bodies that go through them.
  static const Recorded nothing(Type::none, std::vector<Ref>(16, Ref{nullptr, 0, Scalar::f32}));
  return nothing;
}

Float NodeCall::number(std::string_view name) const {
  return Float(part_of(*this, diagnostics_, name, 0, Scalar::f32));
}
Int NodeCall::integer(std::string_view name) const {
  return Int(part_of(*this, diagnostics_, name, 0, Scalar::i32));
}
Bool NodeCall::boolean(std::string_view name) const {
  return Bool(part_of(*this, diagnostics_, name, 0, Scalar::b1));
}

Float2 NodeCall::vector2(std::string_view name) const {
  return {Float(part_of(*this, diagnostics_, name, 0, Scalar::f32)),
          Float(part_of(*this, diagnostics_, name, 1, Scalar::f32))};
}

Float3 NodeCall::vector3(std::string_view name) const {
  return {Float(part_of(*this, diagnostics_, name, 0, Scalar::f32)),
          Float(part_of(*this, diagnostics_, name, 1, Scalar::f32)),
          Float(part_of(*this, diagnostics_, name, 2, Scalar::f32))};
}

Float4 NodeCall::vector4(std::string_view name) const {
  return {Float(part_of(*this, diagnostics_, name, 0, Scalar::f32)),
          Float(part_of(*this, diagnostics_, name, 1, Scalar::f32)),
          Float(part_of(*this, diagnostics_, name, 2, Scalar::f32)),
          Float(part_of(*this, diagnostics_, name, 3, Scalar::f32))};
}

const std::string& NodeCall::text(std::string_view name) const { return in(name).text; }
const ClosurePtr& NodeCall::closure(std::string_view name) const { return in(name).closure; }

Type NodeCall::out_type(std::string_view name) const {
  for (const Port& port : outputs_) {
    if (port.name == name) return port.value.type;
  }
  report_misfit(diagnostics_, *this, name, "the name of an output");
  return Type::none;
}

void NodeCall::put(Port& port, std::vector<Ref> parts) {
  // Whether they are as many as the type has is looked at when the node is done.
  port.value.parts = std::move(parts);
}

void NodeCall::set(ClosurePtr closure) { outputs_.front().value.closure = std::move(closure); }

void NodeCall::copy(std::string_view input) {
  const Recorded& value = in(input);
  if (value.type == out_type()) {
    outputs_.front().value = value;
  } else if (has(input)) {
    report_misfit(diagnostics_, *this, input, std::string(type_name(out_type())));
  }
}

void NodeCall::set(std::string_view name, std::vector<Ref> parts) {
  for (Port& port : outputs_) {
    if (port.name == name) put(port, std::move(parts));
  }
}

}  // namespace nacre
