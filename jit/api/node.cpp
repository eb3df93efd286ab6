// A node whose body a host has written.
#include "jit/api/node.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "jit/api/call.h"
#include "jit/api/lobe.h"
#include "jit/api/recording.h"

using namespace nacre;
using namespace nacre::api;

namespace {

const NodeCall::Port* find(const std::vector<NodeCall::Port>& ports, const char* name) {
  const auto found =
      std::ranges::find(ports, std::string_view(text_or_empty(name)), &NodeCall::Port::name);
  return found != ports.end() ? &*found : nullptr;
}

/// The port that a host means, an output's name being NULL for the first.
const NodeCall::Port* find_output(const nacre_node* node, const char* name) {
  const auto& outputs = node->call.outputs();
  return name == nullptr ? &outputs.front() : find(outputs, name);
}

const char* type_of(const NodeCall::Port* port) {
  return port != nullptr ? type_name(port->value.type).data() : "";
}

}  // namespace

namespace nacre::api {

HostBody host_body(const nacre_body& given) {
  const nacre_body body = options_of(&given);
  HostBody made{.nodedef = text_or_empty(body.nodedef), .record = {}};
  if (body.record == nullptr) return made;
  // Destroyed with the last copy of the function.
  const std::shared_ptr<void> user(body.user, [destroy = body.destroy](void* data) {
    if (destroy != nullptr) destroy(data);
  });
  made.record = [record = body.record, user](NodeCall& call) {
    Recording recording(call.recorder(), call.diagnostics(), call.where());
    nacre_node node{call, recording};
    record(user.get(), &node);
  };
  return made;
}

}  // namespace nacre::api

nacre_recorder* nacre_node_recorder(nacre_node* node) {
  return node != nullptr ? node->recording.handle() : nullptr;
}

const char* nacre_node_nodedef(const nacre_node* node) {
  return node != nullptr ? node->call.nodedef().data() : "";
}

int nacre_node_accuracy(const nacre_node* node) {
  return node != nullptr ? accuracy_number(node->call.accuracy()) : NACRE_STANDARD;
}

const char* nacre_node_input_type(const nacre_node* node, const char* name) {
  if (node == nullptr) return "";
  return type_of(find(node->call.inputs(), name));
}

size_t nacre_node_input(nacre_node* node, const char* name, nacre_value* values, size_t room) {
  if (node == nullptr) return 0;
  const NodeCall::Port* port = find(node->call.inputs(), name);
  if (port == nullptr) {
    node->recording.fail("the nodedef has no input '" + std::string(text_or_empty(name)) + "'");
    return 0;
  }
  const std::vector<Ref>& parts = port->value.parts;
  for (std::size_t i = 0; i < parts.size() && i < room; ++i) {
    values[i] = node->recording.give(parts[i]);
  }
  return parts.size();
}

const char* nacre_node_text(nacre_node* node, const char* name) {
  if (node == nullptr) return "";
  const NodeCall::Port* port = find(node->call.inputs(), name);
  return port != nullptr ? port->value.text.c_str() : "";
}

const char* nacre_node_output_type(const nacre_node* node, const char* name) {
  if (node == nullptr) return "";
  return type_of(find_output(node, name));
}

void nacre_node_set(nacre_node* node, const char* output, const nacre_value* values, size_t count) {
  if (node == nullptr) return;
  const NodeCall::Port* port = find_output(node, output);
  if (port == nullptr) {
    node->recording.fail("the nodedef has no output '" + std::string(text_or_empty(output)) + "'");
    return;
  }
  const auto wanted = static_cast<std::size_t>(component_count(port->value.type));
  if (count != wanted || values == nullptr) {
    node->recording.fail("output '" + port->name + "' is not set to as many numbers as it has",
                         std::to_string(wanted));
    return;
  }
  std::vector<Ref> parts;
  for (std::size_t i = 0; i < count; ++i) {
    parts.push_back(node->recording.take(values[i], scalar_of(port->value.type), "an output"));
  }
  node->call.set(port->name, std::move(parts));
}

void nacre_node_error(nacre_node* node, const char* message) {
  if (node == nullptr) return;
  node->recording.fail(text_or_empty(message));
}

void nacre_node_set_lobe(nacre_node* node, const nacre_lobe* lobe) {
  if (node == nullptr) return;
  if (lobe == nullptr || node->call.out_type() != Type::bsdf) {
    node->recording.fail("a lobe is set where there is no BSDF");
    return;
  }
  set_host_lobe(node->call, *lobe, node->recording);
}
