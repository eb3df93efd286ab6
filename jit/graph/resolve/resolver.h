#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory_resource>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "jit/document/definitions.h"
#include "jit/graph/color/color_transforms.h"
#include "jit/graph/complaints.h"
#include "jit/graph/graph.h"
#include "jit/graph/options.h"
#include "jit/graph/resolve/connection.h"
#include "jit/graph/resolve/implementations.h"
#include "jit/graph/resolve/instances.h"
#include "jit/graph/resolve/literals.h"
#include "jit/graph/resolve/resolved.h"

namespace nacre {

/// Turns elements into the nodes of a Graph, on demand: asked for one port, it
/// visits what that port depends on and nothing else. A stack of its own takes
/// the place of recursion, so that depth is bounded by memory only.
class Resolver {
 public:
  Resolver(const Document& document, const Definitions& definitions, const GraphOptions& options,
           Diagnostics& diagnostics)
      : document_(document),
        definitions_(definitions),
        options_(options),
        complaints_(diagnostics, options.lenient),
        colors_(document, definitions, options, complaints_),
        implementations_(definitions, options, colors_, complaints_),
        instances_(document, definitions, options, implementations_, complaints_),
        literals_(document, options, implementations_, instances_, graph_, complaints_) {}
  Resolver(const Resolver&) = delete;
  Resolver& operator=(const Resolver&) = delete;

  /// What an <output> or an unowned <input> in a context comes to.
  Resolved resolve_port(const Element& port, const Context* context, std::uint32_t leaf = 0);
  /// An output of a node that stands in `context`, null at the root; "" for its only one.
  Resolved resolve_node(const Element& node, std::string_view output,
                        const Context* context = nullptr);
  /// What feeds input `index` of the nodedef of a node that stands in `context`.
  Resolved resolve_input(const Element& node, std::uint32_t index, const Context* context);
  /// A colour as GraphOptions::output_space has it; other results as they are.
  Resolved in_output_space(const Resolved& result, const std::string& name, const Element& user);
  const ColorTransforms& colors() const { return colors_; }
  /// Null, after an error, for an element that is no instance of anything.
  const NodeDef* nodedef_of(const Element& node) { return implementations_.nodedef_of(node); }
  /// What a graph's ports are resolved in.
  const Context* compound(const Element& graph, const Context* parent) {
    return instances_.compound(graph, parent);
  }

  Graph& graph() { return graph_; }
  /// How much of GraphOptions::max_nodes is used up, 1 at the limit.
  double fullness() const;

 private:
  enum class Kind : std::uint8_t { node, output, input, port };
  /// What is being resolved: an instance's node, output or input `index`, or a
  /// port element in a context.
  struct Key {
    Kind kind;
    std::uint32_t index;
    const void* subject;
    const Context* context;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  struct Slot {
    bool done = false;
    Resolved result;
  };
  using Slots = std::pmr::unordered_map<Key, Slot, KeyHash>;
  enum class Stage : std::uint8_t {
    start,
    received,   ///< The source is known, still to be checked.
    converted,  ///< What was waited for is the result.
    switched,   ///< Whether the node is disabled is known.
    retyped,    ///< The source has another type now.
  };
  /// Chains are as long as graphs are large, and so is the stack of frames: what they
  /// come to stands in the slot alone.
  struct Task {
    Key key{};
    Slot* slot = nullptr;
    Resolved& result;
    Stage stage = Stage::start;
    std::uint32_t next_input = 0;  ///< Of a node.
    const Slots::value_type* waiting_for = nullptr;
  };

  // The machine (resolver.cpp).
  Resolved run(Key key);
  std::optional<Key> step(Task& task);
  static Resolved failure();
  static std::size_t bytes_of(const Source& source);
  bool is_too_large(const Task& task);
  bool is_due(const Task& task);
  static const Element& where(const Task& task);
  void report_cycle(const std::deque<Task>& stack, const Key& again);
  static const Resolved& waited(const Task& task) { return task.waiting_for->second.result; }
  /// Of what nothing else will ask for.
  void forget_waited(Task& task) { slots_.erase(Key(task.waiting_for->first)); }

  // One step of each kind: what it has to wait for, or nothing when the task's result
  // stands. Nodes and their outputs (output_steps.cpp).
  std::optional<Key> step_node(Task& task);
  std::optional<Key> step_output(Task& task);
  std::optional<Key> start_output(Task& task, const Instance& instance);
  std::optional<Key> start_enabled_output(Task& task, const Instance& instance);
  std::optional<Key> pass_through(Task& task, const Instance& instance);
  std::optional<Key> finish_native_output(Task& task, const Instance& instance);
  std::optional<Key> convert_texels(Task& task, const Instance& instance, const Resolved& file);
  void add_source(const NodeDef& def);

  // Inputs of nodes (input_steps.cpp).
  std::optional<Key> step_input(Task& task);
  std::optional<Key> start_input(Task& task, const Instance& instance, const NodeDefInput& input);
  std::optional<Key> default_input(Task& task, const Instance& instance, const NodeDefInput& input);
  std::optional<Key> check_input(Task& task, const Instance& instance, const NodeDefInput& input);

  // Elements that are connected, or say a value (port_steps.cpp).
  /// Of a port whose type is a structure, one leaf: 1 + its number.
  static bool is_leaf(const Task& task) { return task.key.index != 0; }
  std::optional<Key> step_port(Task& task);
  std::optional<Key> start_port(Task& task, const Element& port);
  std::optional<Key> take_value(Task& task, const Element& port, Type type);
  std::optional<Key> follow_interface(Task& task, const Element& port, std::string_view name);
  std::optional<Key> miss_interface(Task& task, const Element& port);
  std::optional<Key> port_without_source(Task& task, const Element& port);
  std::optional<Key> check_port_type(Task& task, const Element& port);

  // Nodes put between a value and who reads it (conversions.cpp): the key of what is to be
  // waited for, or nothing where the result is as it should be.
  std::optional<Key> convert_colour(const Source& source, Type type, std::string_view space,
                                    const std::string& path, const Element& user);
  Key transformed(const Source& source, const NodeDef& transform, std::string path,
                  const Element& user);
  std::optional<Key> convert_unit(Resolved& result, const NodeDefInput& input,
                                  const std::string& path, const Element& user);
  std::optional<double> unit_factor(std::string_view from, const NodeDefInput* input,
                                    const Element& user);
  std::optional<Key> scale(const Source& source, Type type, double factor, const std::string& path,
                           const Element& user);
  /// A result of another type that stands for one.
  std::optional<Key> retype(Resolved& result, Type type, const std::string& path,
                            const Element& user);
  static Key output_of(const Instance& instance) { return {Kind::output, 0, &instance, nullptr}; }

  const Document& document_;
  const Definitions& definitions_;
  const GraphOptions& options_;
  Graph graph_;
  Complaints complaints_;
  ColorTransforms colors_;
  Implementations implementations_;
  Instances instances_;
  Literals literals_;

  std::pmr::unsynchronized_pool_resource memory_;
  Slots slots_{&memory_};
  std::unordered_set<std::string_view> with_source_;  ///< Nodedefs in Graph::sources.
  /// What names and values take: a value is written once and copied to wherever it goes.
  std::size_t bytes_ = 0;
  bool too_large_ = false;
  std::size_t steps_ = 0;
  bool due_ = false;
};

}  // namespace nacre
