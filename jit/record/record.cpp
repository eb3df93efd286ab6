#include "jit/record/record.h"

#include <bit>
#include <utility>

namespace nacre {

namespace {

/// The bits of component i of a literal.
std::uint32_t component_bits(const Value& value, std::size_t i) {
  if (value.type == Type::integer || value.type == Type::boolean) {
    return i < value.ints.size() ? static_cast<std::uint32_t>(value.ints[i]) : 0u;
  }
  return i < value.floats.size() ? std::bit_cast<std::uint32_t>(value.floats[i]) : 0u;
}

Scalar scalar_of(Type type) {
  if (type == Type::integer) return Scalar::i32;
  if (type == Type::boolean) return Scalar::b1;
  return Scalar::f32;
}

class GraphRecorder {
 public:
  GraphRecorder(const Graph& graph, const Bodies& bodies, const RecordOptions& options,
                Recorder& recorder, Diagnostics& diagnostics)
      : graph_(graph),
        bodies_(bodies),
        options_(options),
        recorder_(recorder),
        diagnostics_(diagnostics) {}

  std::optional<std::vector<Recorded>> run() {
    for (const GraphNode& node : graph_.nodes) {
      const NodeBody* body = bodies_.find(node.nodedef);
      if (body == nullptr) {
        diagnostics_.error("no-implementation", node.where,
                           "nothing implements node '" + node.category + "'",
                           "a nodedef with a native body or a node graph", node.nodedef);
        return std::nullopt;
      }
      outputs_.push_back(record(node, *body));
      if (count_instructions() > options_.max_instructions) {
        diagnostics_.error(
            "program-too-large", node.where, "the graph leads to too large a kernel",
            std::to_string(options_.max_instructions).append(" instructions at most"));
        return std::nullopt;
      }
    }
    std::vector<Recorded> results;
    for (const GraphOutput& output : graph_.outputs) {
      results.push_back(value_of(output.source, output.type));
    }
    return results;
  }

 private:
  using Ports = std::vector<NodeCall::Port>;

  /// Functions that are recorded stay as they are: each is counted once.
  std::size_t count_instructions() {
    const std::vector<Function>& functions = recorder_.program().functions;
    for (; counted_ < functions.size(); ++counted_)
      in_functions_ += functions[counted_].code.size();
    return in_functions_ + functions.front().code.size();
  }

  Ports record(const GraphNode& node, const NodeBody& body) {
    Ports inputs;
    for (const GraphInput& input : node.inputs) {
      inputs.push_back({input.name, value_of(input.source, input.type)});
    }
    Ports outputs;
    for (const GraphNodeOutput& output : node.outputs) {
      NodeCall::Port port{output.name, {}};
      port.value.type = output.type;
      outputs.push_back(std::move(port));
    }
    NodeCall call(recorder_, node.category, node.nodedef, std::move(inputs), std::move(outputs),
                  options_.accuracy, options_.textures, diagnostics_, node.where);
    if (options_.before_node) options_.before_node(node);
    body.record(call);
    return call.outputs();
  }

  Recorded value_of(const Source& source, Type type) {
    Recorded value;
    value.type = type;
    switch (source.kind) {
      case Source::Kind::unconnected: break;
      case Source::Kind::link: value = outputs_[source.node][source.output].value; break;
      case Source::Kind::literal: return literal(source, type);
      case Source::Kind::parameter: return parameter(graph_.parameters[source.parameter]);
    }
    return value;
  }

  Recorded literal(const Source& source, Type type) const {
    Recorded value;
    value.type = type;
    if (is_text(type)) {
      if (!source.value.texts.empty()) value.text = source.value.texts.front();
      if (type == Type::filename && !value.text.empty() && options_.resolve_file) {
        value.text = options_.resolve_file(value.text, source.document);
      }
      return value;
    }
    const Scalar scalar = scalar_of(type);
    for (int i = 0; i < component_count(type); ++i) {
      std::uint32_t bits = component_bits(source.value, static_cast<std::size_t>(i));
      if (scalar == Scalar::b1) bits = bits != 0;
      value.parts.push_back({nullptr, bits, scalar});
    }
    return value;
  }

  Recorded parameter(const Parameter& parameter) {
    Source frozen;
    frozen.kind = Source::Kind::literal;
    frozen.value = parameter.value;
    if (options_.parameters == ParameterMode::frozen || is_text(parameter.type)) {
      return literal(frozen, parameter.type);
    }
    Recorded value;
    value.type = parameter.type;
    const int count = component_count(parameter.type);
    for (int i = 0; i < count; ++i) {
      value.parts.push_back(
          recorder_.parameter(slot_name(parameter.path, i, count), scalar_of(parameter.type),
                              component_bits(parameter.value, static_cast<std::size_t>(i))));
    }
    return value;
  }

  const Graph& graph_;
  const Bodies& bodies_;
  const RecordOptions& options_;
  Recorder& recorder_;
  Diagnostics& diagnostics_;
  std::vector<Ports> outputs_;  ///< By node.
  std::size_t counted_ = 1;     ///< Functions; the first is the entry.
  std::size_t in_functions_ = 0;
};

}  // namespace

std::optional<std::vector<Recorded>> record_graph(const Graph& graph, const Bodies& bodies,
                                                  const RecordOptions& options, Recorder& recorder,
                                                  Diagnostics& diagnostics) {
  return GraphRecorder(graph, bodies, options, recorder, diagnostics).run();
}

std::string slot_name(const std::string& parameter, int i, int count) {
  if (count == 1) return parameter;
  if (count <= 4) return parameter + '.' + "xyzw"[i];
  return parameter + '.' + std::to_string(i);
}

}  // namespace nacre
