#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "jit/graph/resolve/instances.h"
#include "jit/graph/resolve/resolved.h"

namespace nacre {

/// Values as they are written: literals, live parameters, file names.
class Literals {
 public:
  /// All must outlive it. Parameters go to `graph`.
  Literals(const Document& document, const GraphOptions& options, Implementations& implementations,
           const Instances& instances, Graph& graph, Complaints& complaints)
      : document_(document),
        options_(options),
        implementations_(implementations),
        instances_(instances),
        graph_(graph),
        complaints_(complaints) {}

  /// The `value` of a port, in its own colour space and unit; fails if it does not fit.
  void take(const Element& carrier, Type type, const Context* context, Resolved& result);
  /// Leaf `number` of a structure that is written as a value, or of one that is not written.
  void take_leaf(const Element& carrier, std::size_t number, Resolved& result) const;
  /// A default that may change: of an input of a node of the document's own.
  Source default_parameter(const Instance& instance, const NodeDefInput& input);
  /// A file name with what stands for its tokens, but those of the point and the frame.
  Source file_name(const Element& carrier, const Value& value, const Context* context) const;

  /// Which file of a sequence a texture node reads is its own business (Standard Nodes,
  /// "Texture Node Notes"): the frame plus `frameoffset`, taken into `framerange`.
  void choose_frame(GraphNode& node, const Element& user) const;
  /// Whether an input takes the value. What an outer node may be given, its graph may hand
  /// on, whatever the inner node lists: UsdUVTexture takes "black", and gives it to an image.
  bool check_enum(const NodeDefInput& input, Resolved& result);
  /// A uniform input takes values, and constants passed along by nodes (Specification,
  /// "Inputs"). Fails for others, but for numbers, which may vary, with a warning.
  void make_uniform(const NodeDefInput& input, const Element& user, Resolved& result) const;

 private:
  Source literal_or_parameter(const Element& carrier, Value value, std::string_view unit);
  std::optional<std::string> find_token(std::string_view name, const Element& user,
                                        const Context* context) const;

  const Document& document_;
  const GraphOptions& options_;
  Implementations& implementations_;
  const Instances& instances_;
  Graph& graph_;
  Complaints& complaints_;
  std::unordered_map<const Element*, std::uint32_t> parameters_;
};

}  // namespace nacre
