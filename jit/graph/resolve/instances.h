#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory_resource>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/graph/graph.h"
#include "jit/graph/options.h"
#include "jit/graph/resolve/implementations.h"

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

/// The nodes of the inlined graph and the graphs that they stand in, each made once.
class Instances {
 public:
  /// All must outlive it.
  Instances(const Document& document, const Definitions& definitions, const GraphOptions& options,
            Implementations& implementations, Complaints& complaints)
      : document_(document),
        definitions_(definitions),
        options_(options),
        implementations_(implementations),
        complaints_(complaints) {}

  /// Of an element; null where it is an instance of nothing.
  const Instance* of(const Element& element, const Context* context);
  /// Of no element.
  Instance& add(const NodeDef& def, std::string path, const Element* origin);
  /// "Nworld" as the node that its geompropdef describes; null, after an error, if no node
  /// does.
  const Instance* of_geomprop(std::string_view name, const Element& user);

  /// A graph that stands in `parent`, null at the root.
  const Context* compound(const Element& graph, const Context* parent);
  /// The graph that implements a node; null, after an error, for one that contains itself or
  /// too much.
  const Context* functional(const Instance& instance, const Element& graph);

  /// What says something about an input: of a variant, of the node, or of what it inherits
  /// from. Null: nothing does.
  const Element* input(const Instance& instance, std::string_view name) const;
  /// What the chosen variants say of an input or token of that name; null if nothing. Of
  /// those that do, the last one chosen counts.
  const Element* of_variant(std::string_view category, std::string_view name,
                            const Instance* instance) const;
  /// Nothing, after an error, if there is no such output. `leaf`: of a structure, 1 + number.
  std::optional<std::uint32_t> output_index(const NodeDef& def, std::string_view name,
                                            const Element& user, std::uint32_t leaf = 0);

  std::size_t count() const { return instances_.size(); }
  /// What their paths take, which grow with the depth of graphs.
  std::size_t bytes() const { return bytes_; }

 private:
  const Document& document_;
  const Definitions& definitions_;
  const GraphOptions& options_;
  Implementations& implementations_;
  Complaints& complaints_;

  /// An element where it stands.
  using Place = std::pair<const Element*, const Context*>;
  struct PlaceHash {
    std::size_t operator()(const Place& place) const;
  };

  std::pmr::monotonic_buffer_resource memory_;
  std::pmr::deque<Instance> instances_{&memory_};
  std::pmr::deque<Context> contexts_{&memory_};
  std::pmr::unordered_map<Place, const Instance*, PlaceHash> of_element_{&memory_};
  std::pmr::unordered_map<Place, const Context*, PlaceHash> compounds_{&memory_};
  std::pmr::unordered_map<const Instance*, const Context*> functionals_{&memory_};
  std::map<std::string_view, const Instance*> geomprops_;
  std::size_t bytes_ = 0;
};

}  // namespace nacre
