#include <fmt/format.h>

#include "jit/graph/graph.h"

namespace nacre {

namespace {

std::size_t floats_in(Type type) {
  const bool is_int = type == Type::boolean || type == Type::integer;
  return is_int ? 0 : static_cast<std::size_t>(component_count(type));
}

bool fits(const Value& value) {
  if (is_array(value.type)) return true;
  const bool is_int = value.type == Type::boolean || value.type == Type::integer;
  return value.floats.size() == floats_in(value.type) && value.ints.size() == (is_int ? 1u : 0u) &&
         value.texts.size() == (is_text(value.type) ? 1u : 0u);
}

// What is wrong with a source, or nothing.
std::string fault_of(const Graph& graph, const Source& source, Type type, std::size_t before) {
  switch (source.kind) {
    case Source::Kind::unconnected:
      return is_numeric(type) ? "a numeric port is not connected" : "";
    case Source::Kind::literal:
      if (source.value.type != type) return "a literal has another type than its port";
      return fits(source.value) ? "" : "a literal has the wrong number of components";
    case Source::Kind::parameter:
      if (source.parameter >= graph.parameters.size()) return "a parameter does not exist";
      if (graph.parameters[source.parameter].type != type) {
        return "a parameter has another type than its port";
      }
      return "";
    case Source::Kind::link:
      if (source.node >= before) return "a link does not lead to an earlier node";
      if (source.output >= graph.nodes[source.node].outputs.size()) {
        return "a link leads to an output that does not exist";
      }
      if (graph.nodes[source.node].outputs[source.output].type != type) {
        return "a link leads to an output of another type";
      }
      return "";
  }
  return "";
}

}  // namespace

bool verify(const Graph& graph, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const auto check = [&](const Source& source, Type type, std::size_t before, SourceLocation where,
                         const std::string& port) {
    const std::string fault = fault_of(graph, source, type, before);
    if (fault.empty()) return;
    where.path += (where.path.empty() ? "" : "/") + port;
    diagnostics.error("bad-graph", where, fault);
  };
  for (const Parameter& parameter : graph.parameters) {
    if (parameter.value.type == parameter.type && fits(parameter.value)) continue;
    diagnostics.error("bad-graph", parameter.where, "a parameter's value does not fit its type");
  }
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    for (const GraphInput& input : graph.nodes[i].inputs) {
      check(input.source, input.type, i, graph.nodes[i].where, input.name);
    }
  }
  for (const GraphOutput& output : graph.outputs) {
    check(output.source, output.type, graph.nodes.size(), {}, output.name);
  }
  return diagnostics.error_count() == errors;
}

}  // namespace nacre
