#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jit/graph/text_table.h"
#include "runtime/diagnostic.h"
#include "runtime/type.h"
#include "runtime/value.h"

namespace nacre {

/// What feeds an input of a node or an output of a graph.
struct Source {
  /// Which of the members say it.
  enum class Kind : std::uint8_t {
    unconnected,  ///< A closure, shader or material input that nothing feeds.
    literal,      ///< `value`
    link,         ///< Output `output` of node `node`.
    parameter,    ///< Parameter `parameter`; its value is in Graph::parameters.
  };
  Kind kind = Kind::unconnected;  ///< Which of the following count.
  std::uint32_t node = 0;         ///< Of a link: index in Graph::nodes, before the reader's own.
  std::uint32_t output = 0;       ///< Of a link: index in GraphNode::outputs.
  std::uint32_t parameter = 0;    ///< Of a parameter: index in Graph::parameters.
  Value value;                    ///< Of a literal.

  /// Only for a literal of type filename. `colorspace`: the space the image is
  /// encoded in ("" or "none": as it is). Conversion to the working space is in
  /// the graph already, as nodes behind the texture node's colour outputs: who
  /// reads the texels must not convert them again.
  std::string colorspace;
  /// Only for a literal of type filename: the file that wrote the name, ""
  /// without one. Relative names are looked up beside it first.
  std::string document;

  bool operator==(const Source&) const = default;
};

/// An input of a node, with what feeds it.
struct GraphInput {
  std::string name;        ///< As the nodedef has it.
  Type type = Type::none;  ///< That of the nodedef, and of `source`.
  Source source;           ///< A literal where nobody said anything: the default.
};

/// An output of a node.
struct GraphNodeOutput {
  std::string name;        ///< As the nodedef has it.
  Type type = Type::none;  ///< That of the nodedef.
  /// The nodedef's `default` of this output; type none if it names none.
  Value default_value;
};

/// One instance of one nodedef.
struct GraphNode {
  std::string category;  ///< "mix"
  std::string nodedef;   ///< "ND_mix_color3"
  std::string path;      ///< For people: "NG_marble/mix1", "SR/fresnel/mix1" once inlined.
  std::vector<GraphInput> inputs;        ///< Every input of the nodedef, in its order.
  std::vector<GraphNodeOutput> outputs;  ///< Every output of the nodedef, in its order.
  SourceLocation where;                  ///< Of the instance.

  /// The input of that name, or null.
  const GraphInput* input(std::string_view name) const;
};

/// A value that the author wrote on an instance or a graph's interface, numeric
/// and not uniform, so that it may change without recompiling.
struct Parameter {
  std::string path;        ///< Public name: "NG_marble/mix1/fg", "SR_marble/base_color".
  Type type = Type::none;  ///< Numeric.
  Value value;             ///< As written: before unit and colour conversion.
  std::string colorspace;  ///< Of `value`; "" if none was given or needed.
  std::string unit;        ///< Of `value`; "" if none was given.
  std::string nodedef;     ///< Of the instance it is written on; "" for a graph's interface.
  std::string input;       ///< Name of the input it is written on.
  /// Nobody wrote it: the nodedef's default, of GraphOptions::default_parameters.
  bool is_default = false;
  /// From the input or the nodedef's input; all ui_* may be empty.
  /// @{
  std::string ui_name;
  std::string ui_folder;
  std::string doc;
  /// @}
  /// Type none when not given. uisoftmin / uimin.
  /// @{
  Value ui_min, ui_max;
  /// @}
  SourceLocation where;  ///< Of the input it is written on.
};

/// Something that was asked for.
struct GraphOutput {
  std::string name;           ///< "NG_marble/out", "out"; for a material "surfaceshader" and so on.
  Type type = Type::none;     ///< That of `source`.
  Source source;              ///< What feeds it.
  SourceLocation where = {};  ///< Of what was asked for.
};

/// What implements a nodedef by text: MaterialX's `<implementation>` with `file`
/// or `sourcecode`, in the GLSL subset of jit/glsl.
struct NodeText {
  std::string nodedef;   ///< The one it implements: "ND_my_noise_float".
  std::string file;      ///< With `function`; relative to `document`.
  std::string text;      ///< Instead of a file: an expression, "{{in1}} + {{in2}}", or with
                         ///< `function` the text of one.
  std::string function;  ///< Called with the inputs, then the outputs, in the nodedef's order;
                         ///< of a lobe, what the names of its functions begin with.
  std::string document;  ///< The file that names it.
  /// Allowed values of string inputs; a text gets the index of one.
  std::vector<std::pair<std::string, std::vector<std::string>>> enums;
  std::vector<TextTable> tables;  ///< Bound to the uniform samplers of the text.
  SourceLocation where;           ///< Of the `<implementation>`.
  /// Of a lobe, what its nodedef says by `bsdf`: "R", "T" or "RT"; "": "R".
  std::string sides;
};

/// Typed nodes and connections, and nothing else: nodedefs resolved, node graphs
/// inlined, defaults filled in, geometric defaults, unit and colour-space
/// conversions inserted as nodes, unreachable parts gone, no cycles. A node
/// links only to nodes before it. Fill one in from any scene format, with
/// GraphBuilder or by hand; check it with `verify`.
struct Graph {
  std::vector<GraphNode> nodes;       ///< In an order in which they can be computed.
  std::vector<Parameter> parameters;  ///< What may change without another topology.
  std::vector<GraphOutput> outputs;   ///< In the order asked for.
  /// For nodes whose nodedef has neither a body nor a graph; each nodedef once.
  std::vector<NodeText> texts;
  /// Main file of the document that it was built from, "" without one: the files that a
  /// document names lie below its folder (see ShaderOptions::files_anywhere).
  std::string document;
};

/// The parameter of that path, to be read or given another value, or null. Graphs that
/// differ in values only have the same topology_hash, and live kernels in common.
Parameter* find_parameter(Graph& graph, std::string_view path);

/// Canonical text, one line per parameter, node and output:
///
///   parameter 0 float "NG/mix1/mix" = 0.5
///   %0 = ND_texcoord_vector2(index=0) : vector2
///   %1 = ND_mix_color3(fg=%0, bg=[0, 0, 0], mix=$0) : color3
///   output "NG/out" color3 = %1
///
/// Floats print in the shortest form that reads back to the same bits. The same
/// graph always prints the same text; paths and locations of nodes are left out.
std::string to_string(const Graph& graph);

/// Equal for graphs that differ only in parameter values, names of parameters
/// and outputs, paths and locations: one kernel fits them all. 64-bit, stable
/// between runs and machines; equality of texts decides, never the hash alone.
std::uint64_t topology_hash(const Graph& graph);

/// True if links point backwards to outputs that exist, parameter references
/// exist, types agree and literals have the right number of components.
/// Otherwise adds an error for each fault.
bool verify(const Graph& graph, Diagnostics& diagnostics);

}  // namespace nacre
