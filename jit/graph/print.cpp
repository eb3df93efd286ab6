#include <fmt/format.h>

#include <iterator>

#include "jit/graph/graph.h"

namespace nacre {

namespace {

using Out = std::back_insert_iterator<std::string>;

void print_text(Out out, std::string_view text) {
  fmt::format_to(out, "\"");
  for (char c : text) {
    if (c == '"' || c == '\\') fmt::format_to(out, "\\");
    if (c == '\n') {
      fmt::format_to(out, "\\n");
    } else {
      fmt::format_to(out, "{}", c);
    }
  }
  fmt::format_to(out, "\"");
}

void print_value(Out out, const Value& value) {
  if (value.type == Type::boolean && value.ints.size() == 1) {
    fmt::format_to(out, "{}", value.ints[0] != 0);
    return;
  }
  const std::size_t count = value.floats.size() + value.ints.size() + value.texts.size();
  const bool brackets = count != 1 || is_array(value.type);
  const char* separator = "";
  if (brackets) fmt::format_to(out, "[");
  for (float number : value.floats) {
    fmt::format_to(out, "{}{}", separator, number);
    separator = ", ";
  }
  for (std::int32_t number : value.ints) {
    fmt::format_to(out, "{}{}", separator, number);
    separator = ", ";
  }
  for (const std::string& text : value.texts) {
    fmt::format_to(out, "{}", separator);
    print_text(out, text);
    separator = ", ";
  }
  if (brackets) fmt::format_to(out, "]");
}

void print_source(Out out, const Graph& graph, const Source& source) {
  switch (source.kind) {
    case Source::Kind::unconnected: fmt::format_to(out, "none"); return;
    case Source::Kind::parameter: fmt::format_to(out, "${}", source.parameter); return;
    case Source::Kind::literal:
      print_value(out, source.value);
      if (!source.colorspace.empty()) fmt::format_to(out, "@{}", source.colorspace);
      return;
    case Source::Kind::link:
      fmt::format_to(out, "%{}", source.node);
      if (source.node < graph.nodes.size() && graph.nodes[source.node].outputs.size() > 1 &&
          source.output < graph.nodes[source.node].outputs.size()) {
        fmt::format_to(out, ".{}", graph.nodes[source.node].outputs[source.output].name);
      }
      return;
  }
}

void print_node(Out out, const Graph& graph, std::size_t index) {
  const GraphNode& node = graph.nodes[index];
  fmt::format_to(out, "%{} = {}(", index, node.nodedef);
  const char* separator = "";
  for (const GraphInput& input : node.inputs) {
    fmt::format_to(out, "{}{}=", separator, input.name);
    print_source(out, graph, input.source);
    separator = ", ";
  }
  fmt::format_to(out, ") :");
  for (const GraphNodeOutput& output : node.outputs) {
    fmt::format_to(out, " {}", type_name(output.type));
  }
  fmt::format_to(out, "\n");
}

void print_table(Out out, const TextTable& table) {
  fmt::format_to(out, " {}={}x{}x{}x{} {} {}", table.name, table.size[0], table.size[1],
                 table.size[2], table.channels,
                 table.filter == TextTable::Filter::linear ? "linear" : "nearest",
                 table.values == nullptr ? "none" : table.values->digest());
}

// Nodes and what they are connected to, without anything that may change while
// a kernel stays the same.
std::string print_nodes(const Graph& graph) {
  std::string text;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    print_node(std::back_inserter(text), graph, i);
  }
  for (const NodeText& source : graph.texts) {
    fmt::format_to(std::back_inserter(text), "source {} ", source.nodedef);
    print_text(std::back_inserter(text), source.file.empty() ? source.text : source.file);
    if (!source.function.empty()) {
      fmt::format_to(std::back_inserter(text), " {}", source.function);
    }
    if (!source.sides.empty()) print_text(std::back_inserter(text += " bsdf="), source.sides);
    for (const TextTable& table : source.tables) print_table(std::back_inserter(text), table);
    text += '\n';
  }
  return text;
}

// FNV-1a, 64 bits (Fowler, Noll, Vo).
std::uint64_t hash_text(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3u;
  }
  return hash;
}

}  // namespace

std::string to_string(const Graph& graph) {
  std::string text;
  const Out out = std::back_inserter(text);
  for (std::size_t i = 0; i < graph.parameters.size(); ++i) {
    const Parameter& parameter = graph.parameters[i];
    fmt::format_to(out, "parameter {} {} ", i, type_name(parameter.type));
    print_text(out, parameter.path);
    fmt::format_to(out, " = ");
    print_value(out, parameter.value);
    if (!parameter.unit.empty()) fmt::format_to(out, " {}", parameter.unit);
    if (!parameter.colorspace.empty()) fmt::format_to(out, " @{}", parameter.colorspace);
    fmt::format_to(out, "\n");
  }
  text += print_nodes(graph);
  for (const GraphOutput& output : graph.outputs) {
    fmt::format_to(out, "output ");
    print_text(out, output.name);
    fmt::format_to(out, " {} = ", type_name(output.type));
    print_source(out, graph, output.source);
    fmt::format_to(out, "\n");
  }
  return text;
}

std::uint64_t topology_hash(const Graph& graph) {
  std::string text;
  const Out out = std::back_inserter(text);
  for (const Parameter& parameter : graph.parameters) {
    fmt::format_to(out, "{}\n", type_name(parameter.type));
  }
  text += print_nodes(graph);
  for (const GraphOutput& output : graph.outputs) {
    fmt::format_to(out, "{} ", type_name(output.type));
    print_source(out, graph, output.source);
    fmt::format_to(out, "\n");
  }
  return hash_text(text);
}

}  // namespace nacre
