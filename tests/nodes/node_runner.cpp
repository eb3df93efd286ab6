#include "tests/nodes/node_runner.h"

#include <gtest/gtest.h>

#include <limits>

#include "jit/passes/derive.h"
#include "nodes/nodes.h"

namespace nacre {

namespace {

Recorded recorded_input(Recorder& recorder, const NodePort& port) {
  Recorded value;
  value.type = port.type;
  value.text = port.text;
  const int count = component_count(port.type);
  for (int i = 0; i < count; ++i) {
    value.parts.push_back(
        recorder.input(component_name(port.name, i, count), scalar_of(port.type)));
  }
  return value;
}

const NodeBody* body_of(const std::string& category) {
  for (const NodeBody& body : standard_nodes()) {
    if (body.category == category) return &body;
  }
  return nullptr;
}

}  // namespace

std::string component_name(const std::string& port, int i, int count) {
  if (count == 1) return port;
  if (count <= 4) return port + '.' + "xyzw"[i];
  return port + '.' + std::to_string(i);
}

std::vector<NodeCall::Port> record_node(Recorder& recorder, const NodeUnderTest& node) {
  std::vector<NodeCall::Port> inputs;
  for (const NodePort& port : node.inputs) {
    inputs.push_back({port.name, recorded_input(recorder, port)});
  }
  std::vector<NodeCall::Port> outputs;
  for (const NodePort& port : node.outputs) {
    outputs.push_back({port.name, {}});
    outputs.back().value.type = port.type;
  }
  Diagnostics diagnostics;
  NodeCall call(recorder, node.category, "ND_" + node.category, inputs, outputs, Accuracy::precise,
                nullptr, diagnostics, {});
  const NodeBody* body = body_of(node.category);
  if (body == nullptr) {
    ADD_FAILURE() << "no body for " << node.category;
    return outputs;
  }
  body->record(call);
  return call.outputs();
}

Program node_program(const NodeUnderTest& node) {
  Recorder recorder;
  std::vector<SliceOutput> results;
  for (const NodeCall::Port& port : record_node(recorder, node)) {
    const auto count = static_cast<int>(port.value.parts.size());
    for (int i = 0; i < count; ++i) {
      results.push_back(
          {component_name(port.name, i, count), port.value.parts[static_cast<std::size_t>(i)]});
    }
  }
  std::vector<std::string_view> varying;
  for (const NodePort& port : node.inputs) varying.push_back(port.name);
  return derive(slice(recorder.program(), node.category, results), varying);
}

DoubleColumns run_node(const NodeUnderTest& node, const Columns& inputs) {
  return run_double(*make_reference(node_program(node)), inputs);
}

std::vector<double> call_node(const std::string& category, const std::vector<Arg>& args, Type out) {
  NodeUnderTest node{category, {}, {{"out", out}}};
  Columns columns;
  for (const Arg& arg : args) {
    node.inputs.push_back({arg.name, arg.type, arg.text});
    const int count = component_count(arg.type);
    for (int i = 0; i < count; ++i) {
      columns[component_name(arg.name, i, count)] = {arg.values.at(static_cast<std::size_t>(i))};
    }
  }
  const DoubleColumns results = run_node(node, columns);
  std::vector<double> values;
  const int count = component_count(out);
  for (int i = 0; i < count; ++i) {
    values.push_back(results.at(component_name("out", i, count)).front());
  }
  return values;
}

double call_scalar(const std::string& category,
                   const std::vector<std::pair<std::string, float>>& args) {
  std::vector<Arg> list;
  for (const auto& [name, value] : args) list.push_back({name, Type::float_, {value}});
  return call_node(category, list, Type::float_).front();
}

std::vector<float> hostile_floats() {
  using Limits = std::numeric_limits<float>;
  std::vector<float> values{0.0f,
                            -0.0f,
                            Limits::denorm_min(),
                            Limits::min(),
                            -Limits::min(),
                            Limits::max(),
                            -Limits::max(),
                            Limits::infinity(),
                            -Limits::infinity(),
                            Limits::quiet_NaN(),
                            1e-20f,
                            -1e-20f,
                            1e20f,
                            -1e20f};
  for (int i = -20; i <= 20; ++i) {
    values.push_back(static_cast<float>(i));
    values.push_back(static_cast<float>(i) * 0.37f + 0.01f);
  }
  return values;
}

}  // namespace nacre
