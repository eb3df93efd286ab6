#include "runtime/node/node_call.h"

#include <cassert>
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

const Recorded& NodeCall::in(std::string_view name) const {
  for (const Port& port : inputs_) {
    if (port.name == name) return port.value;
  }
  assert(false && "the nodedef has no such input");
  return inputs_.front().value;
}

Float NodeCall::number(std::string_view name) const { return Float(in(name).parts.at(0)); }
Int NodeCall::integer(std::string_view name) const { return Int(in(name).parts.at(0)); }
Bool NodeCall::boolean(std::string_view name) const { return Bool(in(name).parts.at(0)); }

Float2 NodeCall::vector2(std::string_view name) const {
  const Recorded& value = in(name);
  return {value.number(0), value.number(1)};
}

Float3 NodeCall::vector3(std::string_view name) const {
  const Recorded& value = in(name);
  return {value.number(0), value.number(1), value.number(2)};
}

Float4 NodeCall::vector4(std::string_view name) const {
  const Recorded& value = in(name);
  return {value.number(0), value.number(1), value.number(2), value.number(3)};
}

const std::string& NodeCall::text(std::string_view name) const { return in(name).text; }
const ClosurePtr& NodeCall::closure(std::string_view name) const { return in(name).closure; }

Type NodeCall::out_type(std::string_view name) const {
  for (const Port& port : outputs_) {
    if (port.name == name) return port.value.type;
  }
  assert(false && "the nodedef has no such output");
  return Type::none;
}

void NodeCall::put(Port& port, std::vector<Ref> parts) {
  assert(static_cast<int>(parts.size()) == component_count(port.value.type));
  port.value.parts = std::move(parts);
}

void NodeCall::set(ClosurePtr closure) { outputs_.front().value.closure = std::move(closure); }

void NodeCall::copy(std::string_view input) {
  assert(type(input) == out_type());
  outputs_.front().value = in(input);
}

void NodeCall::set(std::string_view name, std::vector<Ref> parts) {
  for (Port& port : outputs_) {
    if (port.name == name) put(port, std::move(parts));
  }
}

}  // namespace nacre
