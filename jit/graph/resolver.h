#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "jit/document/definitions.h"
#include "jit/graph/build.h"
#include "jit/graph/connection.h"
#include "jit/graph/graph.h"

namespace nacre {

struct Context;

/// A node as it occurs once in the inlined graph: an element in one context, or
/// a node that the resolver itself put there (then `element` is null).
struct Instance {
  const Element* element = nullptr;
  const NodeDef* def = nullptr;
  const Context* context = nullptr;  ///< Where it stands; null at the root.
  std::string path;
  const Element* origin = nullptr;  ///< Whose location diagnostics show.
  /// Inputs of a node without element; others take the nodedef's default.
  std::vector<std::pair<std::string_view, Source>> inputs;
};

/// A node graph being looked into. One that implements a nodedef has the
/// instance it stands for; a compound one has none.
struct Context {
  const Element* graph = nullptr;
  const Instance* instance = nullptr;
  const NodeDef* def = nullptr;
  const Context* parent = nullptr;  ///< Context of what its inputs connect to.
  std::string path;
};

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
        diagnostics_(diagnostics),
        working_space_(find_working_space(options, document)) {}

  struct Result {
    bool failed = false;
    Type type = Type::none;
    Source source;
    std::string_view unit;             ///< Still to be converted from; "" if not.
    const Element* carrier = nullptr;  ///< The element that wrote the literal.
    bool is_absent = false;            ///< Says nothing after all: the default counts.
  };

  /// What an <output> or an unowned <input> in a context comes to.
  Result resolve_port(const Element& port, const Context* context, std::uint32_t leaf = 0);
  /// An output of a node that stands in `context`, null at the root; "" for its only one.
  Result resolve_node(const Element& node, std::string_view output,
                      const Context* context = nullptr);
  /// A colour as GraphOptions::output_space has it; other results as they are.
  Result in_output_space(const Result& result, const std::string& name, const Element& user);
  const NodeDef* nodedef_of(const Element& node);
  const Context* compound_context(const Element& graph, const Context* parent);

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
    Result result;
  };
  /// Chains are as long as graphs are large, and so is the stack of frames: what they
  /// come to stands in the slot alone.
  struct Frame {
    Key key{};
    Slot* slot = nullptr;
    Result& result;
    std::uint32_t stage = 0;
    Key waiting_for{};
  };

  // The machine (resolver.cpp).
  Result run(Key key);
  std::optional<Key> step(Frame& frame);
  static Result failure();
  static std::size_t bytes_of(const Source& source);
  bool is_too_large(const Frame& frame);
  bool is_due(const Frame& frame);
  static const Element& where(const Frame& frame);
  void report_cycle(const std::deque<Frame>& stack, const Key& again);
  const Result& waited(const Frame& frame) { return slots_.at(frame.waiting_for).result; }

  // One step of each kind (steps.cpp): what it has to wait for, or nothing when
  // the frame's result stands.
  std::optional<Key> step_node(Frame& frame);
  std::optional<Key> step_output(Frame& frame);
  std::optional<Key> start_output(Frame& frame, const Instance& instance);
  std::optional<Key> start_enabled_output(Frame& frame, const Instance& instance);
  std::optional<Key> pass_through(Frame& frame, const Instance& instance);
  std::optional<Key> finish_native_output(Frame& frame, const Instance& instance);
  std::optional<Key> step_input(Frame& frame);
  std::optional<Key> start_input(Frame& frame, const Instance& instance, const NodeDefInput& input);
  std::optional<Key> default_input(Frame& frame, const Instance& instance,
                                   const NodeDefInput& input);
  std::optional<Key> check_input(Frame& frame, const Instance& instance, const NodeDefInput& input);
  std::optional<Key> step_port(Frame& frame);
  std::optional<Key> follow_interface(Frame& frame, const Element& port, std::string_view name,
                                      const Context* context);
  std::optional<Key> port_without_source(Frame& frame, const Element& port);
  std::optional<Key> check_port_type(Frame& frame, const Element& port);

  // Instances and contexts (instances.cpp).
  const Instance* instance_of(const Element& element, const Context* context);
  const Context* functional_context(const Instance& instance, const Element& graph);
  Instance& add_instance(const NodeDef& def, std::string path, const Element* origin);
  const Instance* geomprop_instance(std::string_view name, const Element& user);
  const Element* input_element(const Instance& instance, std::string_view name) const;
  const Element* variant_child(std::string_view category, std::string_view name,
                               const Instance* instance) const;
  std::optional<std::uint32_t> output_index(const NodeDef& def, std::string_view name,
                                            const Element& user, std::uint32_t leaf = 0);
  bool is_native(const NodeDef& def) const;
  bool has_body(const NodeDef& def) const;
  bool runs_source(const NodeDef& def) const;
  void add_source(const NodeDef& def);
  void say_unused_replacements(const NodeDef& def);
  const Definitions& definitions_of(const Element& element) const;
  const Element* graph_of(const NodeDef& def) const;

  // Literals (literals.cpp).
  std::optional<Key> take_literal(Frame& frame, const Element& carrier, Type type,
                                  const Context* context);
  std::optional<Key> take_leaf(Frame& frame, const Element& carrier);
  Source literal_or_parameter(const Element& carrier, Value value, std::string_view unit);
  Source filename_source(const Element& carrier, const Value& value, const Context* context);
  void choose_frame(GraphNode& node, const Element& user);
  std::optional<std::string> find_token(std::string_view name, const Element& user,
                                        const Context* context) const;
  bool check_enum(const NodeDefInput& input, Result& result);
  void make_uniform(Result& result, const NodeDefInput& input, const Element& user);

  // Conversions (conversions.cpp). The key of the converted value, or nothing
  // when there is nothing to convert.
  std::optional<Key> convert_colour(const Source& source, Type type, std::string_view space,
                                    const std::string& path, const Element& user);
  /// A transform between two spaces; null: nothing is to be done, or there is none.
  struct Conversion {
    const NodeDef* transform = nullptr;
    bool failed = false;
  };
  Conversion find_conversion(Type type, std::string_view from, std::string_view to,
                             const Element& user);
  Key transformed(const Source& source, const NodeDef& transform, std::string path,
                  const Element& user);
  void report_no_transform(std::string_view from, std::string_view to, const Element& user);
  const NodeDef* find_transform(std::string_view from, std::string_view to, Type type);
  // Transforms of GraphOptions::colors (config_transform.cpp).
  struct Transform;
  struct ConfigSpaces {
    ColorConfig::Space from, to;
    /// Built-in spaces on the other side of `from` or of `to`, which then is the space
    /// of ACES 2065-1; "": none.
    std::string before, after;
  };
  static bool is_conversion(const ConfigSpaces& spaces);
  std::optional<ConfigSpaces> config_spaces(std::string_view from, std::string_view to) const;
  std::optional<ConfigSpaces> bridged_spaces(std::string_view from, std::string_view to) const;
  const NodeDef* find_config_transform(const ConfigSpaces& spaces, Type type, const Element& user);
  const Transform* config_transform_of(const NodeDef& def) const;
  NodeSource config_source(const NodeDef& def, const Transform& transform) const;
  std::optional<Key> convert_unit(Result& result, const NodeDefInput& input,
                                  const std::string& path, const Element& user);
  std::optional<double> unit_factor(std::string_view from, const NodeDefInput* input,
                                    const Element& user);
  std::optional<Key> scale(const Source& source, Type type, double factor, const std::string& path,
                           const Element& user);

  // Leniencies (tolerate.cpp).
  /// True, with a warning that ends in `so`, where GraphOptions::lenient goes on; else an
  /// error.
  bool tolerates(std::string code, const Element& element, const std::string& message,
                 std::string_view so, std::string expected = {}, std::string found = {});
  Connection connection_of(const Element& port);
  /// A result of another type that stands for one: what is to be waited for, or nothing
  /// where the result has it now.
  std::optional<Key> retype(Result& result, Type type, const std::string& path,
                            const Element& user);

  void error(std::string code, const Element& element, std::string message,
             std::string expected = {}, std::string found = {});
  void warning(std::string code, const Element& element, std::string message,
               std::string expected = {}, std::string found = {});

  const Document& document_;
  const Definitions& definitions_;
  const GraphOptions& options_;
  Diagnostics& diagnostics_;
  const std::string working_space_;
  Graph graph_;

  std::unordered_map<Key, Slot, KeyHash> slots_;
  std::deque<Instance> instances_;
  std::deque<Context> contexts_;
  std::map<std::pair<const Element*, const Context*>, const Instance*> instance_of_;
  std::map<std::pair<const Element*, const Context*>, const Context*> compounds_;
  std::unordered_map<const Instance*, const Context*> functionals_;
  std::unordered_map<const Element*, const NodeDef*> nodedefs_;
  std::map<std::string_view, const Instance*> geomprops_;
  std::unordered_map<const Element*, std::uint32_t> parameters_;
  /// Colour transforms that the library lacks, by "from_to_to"; null: not known. Those
  /// of a configuration by "from\nto".
  struct Transform {
    std::unique_ptr<Document> document;
    std::unique_ptr<Definitions> definitions;
    std::shared_ptr<const ColorTransform> color;  ///< Of a configuration; null: see `fault`.
    ConfigSpaces spaces;
    std::string name;
    std::string fault;
    SourceLocation where;
  };
  std::map<std::string, Transform, std::less<>> transforms_;
  std::unordered_map<std::string, bool> reported_;    // warnings given once
  std::unordered_set<std::string_view> with_source_;  ///< Nodedefs in Graph::sources.
  /// What names and values take: paths grow with the depth of graphs, and a value is
  /// written once and copied to wherever it goes.
  std::size_t bytes_ = 0;
  bool too_large_ = false;
  std::size_t steps_ = 0;
  bool due_ = false;
};

}  // namespace nacre
