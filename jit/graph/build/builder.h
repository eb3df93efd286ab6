#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jit/document/library.h"
#include "jit/graph/build/build.h"
#include "jit/graph/graph.h"

namespace nacre {

/// Makes a Graph without a document, for hosts with a scene format of their own:
///
///   GraphBuilder builder(library);
///   auto position = builder.add_node("ND_position_vector3", "where");
///   auto scale = builder.parameter("frequency", {Type::float_, {4}, {}, {}});
///   auto noise = builder.add_node("ND_noise3d_float", "noise");
///   builder.connect(noise, "position", position);
///   builder.connect(noise, "amplitude", scale);
///   builder.output("out", noise);
///   std::optional<Graph> graph = builder.finish({}, diagnostics);
///
/// Inputs that are not set take the nodedef's default. Node graphs are inlined
/// and conversions inserted as for a document. A wrong call is kept and
/// reported by `finish`; it never throws. The library must outlive the builder.
class GraphBuilder {
 public:
  /// Stands for a node of this builder.
  struct Node {
    std::uint32_t index;  ///< Counts the calls of add_node.
  };
  /// Stands for a parameter of this builder.
  struct ParameterId {
    std::uint32_t index;  ///< Counts the calls of parameter().
  };

  /// An empty graph, of nodes that `library` declares.
  explicit GraphBuilder(const Library& library);
  ~GraphBuilder();
  GraphBuilder(const GraphBuilder&) = delete;
  GraphBuilder& operator=(const GraphBuilder&) = delete;

  /// `path` is what diagnostics and GraphNode::path call it; any text.
  Node add_node(std::string_view nodedef, std::string path);
  /// A literal, never a parameter. `colorspace` and `unit` as in a document.
  void set(Node node, std::string_view input, const Value& value, std::string_view colorspace = {},
           std::string_view unit = {});
  /// `output` may be left out if the source has one only.
  void connect(Node node, std::string_view input, Node source, std::string_view output = {});
  /// A parameter as the source; the types must agree.
  void connect(Node node, std::string_view input, ParameterId source);
  /// A live value of a numeric type, to feed any number of inputs.
  ParameterId parameter(std::string path, const Value& value, std::string_view colorspace = {},
                        std::string_view unit = {});
  /// Asks for an output of a node under that name; those of a material are named as
  /// GraphRequest::material has them. `output` as in connect().
  void output(std::string name, Node source, std::string_view output = {});

  /// The graph, or nothing after an error. May be called once.
  std::optional<Graph> finish(const GraphOptions& options, Diagnostics& diagnostics);

 private:
  struct NodeRow {
    const NodeDef* def;
    std::string path;
    Element* element;
  };
  struct ParameterRow {
    std::string path;
    Type type;
  };

  Element& add_element(Element& parent, std::string_view category, const std::string& name,
                       std::string_view type);
  void set_attribute(Element& element, std::string_view name, std::string_view value);
  void set_value(Element& element, const Value& value, std::string_view colorspace,
                 std::string_view unit, const std::string& path);
  Element* input_element(Node node, std::string_view input, Type type);
  const NodeDefOutput* find_output(Node source, std::string_view output, const std::string& user);
  void fail(std::string code, std::string path, std::string message, std::string expected = {},
            std::string found = {}, std::string hint = {});
  std::string public_path(std::string_view path) const;

  const Library& library_;
  // Host calls become elements of a document, so that there is one resolver only.
  std::unique_ptr<Document> document_;
  std::vector<NodeRow> nodes_;
  std::vector<ParameterRow> parameters_;
  std::vector<std::string> outputs_;
  Diagnostics faults_;
};

}  // namespace nacre
