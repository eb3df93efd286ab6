#include "jit/graph/build/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "jit/document/select.h"
#include "jit/graph/build/try_all_graphs.h"
#include "jit/graph/find.h"
#include "jit/graph/prune.h"
#include "jit/graph/resolve/resolver.h"
#include "runtime/float_environment.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

SourceLocation at_root(const Document& document, std::string path) {
  SourceLocation where = location(document.root());
  where.path = std::move(path);
  return where;
}

class GraphBuild {
 public:
  GraphBuild(const Document& document, const Definitions& definitions, const GraphOptions& options,
             Diagnostics& diagnostics)
      : document_(document),
        definitions_(definitions),
        diagnostics_(diagnostics),
        resolver_(document, definitions, options, diagnostics) {
    for (const VariantChoice& choice : options.variants) check_variant(choice);
    const std::size_t errors = diagnostics.error_count();
    check_space("working_space", options.working_space.value_or(""));
    check_space("output_space", options.output_space);
    check_distance_unit(options.distance_unit);
    knows_options_ = diagnostics.error_count() == errors;
  }

  /// Whether there are the spaces and the unit that were asked for. Else nothing is worth adding:
  /// all that is converted would be an error again.
  bool knows_options() const { return knows_options_; }

  void add_output(const std::string& name) {
    const Element* element = find_element(document_, name);
    if (element == nullptr || element == &document_.root()) {
      diagnostics_.error("unknown-request", at_root(document_, name),
                         "the document has no such output", "GRAPH/NAME or NAME",
                         fmt::format("'{}'", name), near_output(name));
      return;
    }
    if (element->category() == "nodegraph") {
      const Element* only = nullptr;
      for (const Element& child : element->children()) {
        if (child.category() != "output") continue;
        if (only != nullptr) return report_several(*element);
        only = &child;
      }
      if (only != nullptr) element = only;
    }
    if (element->category() == "output") {
      if (const StructType* type = definitions_.struct_type(element->attribute("type"))) {
        for (std::uint32_t i = 0; i < type->leaves.size(); ++i) {
          add(name + type->leaves[i].path,
              resolver_.resolve_port(*element, context_around(*element), i + 1), *element);
        }
        return;
      }
      const Resolved found = resolver_.resolve_port(*element, context_around(*element));
      add(name, resolver_.in_output_space(found, name, *element), *element);
    } else if (is_node(*element) && element->parent() == &document_.root()) {
      add_node(name, *element);
    } else {
      diagnostics_.error("unknown-request", location(*element), "this is not an output",
                         "an <output>, a graph or a node of the document");
    }
  }

  void add_value(const std::string& name) {
    const Element* element = find_element(document_, name);
    if (element != nullptr && is_node(*element)) return add_value_of(name, *element, "");
    if (element != nullptr && element->category() == "output") return add_output(name);
    // A port, which need not be written down.
    const std::size_t slash = name.rfind('/');
    const Element* node =
        slash == std::string::npos ? nullptr : find_element(document_, name.substr(0, slash));
    if (node != nullptr && is_node(*node)) {
      return add_value_of(name, *node, std::string_view(name).substr(slash + 1));
    }
    diagnostics_.error("unknown-request", at_root(document_, name),
                       "the document has no such node, output or input",
                       "NODE, NODE/PORT or GRAPH/...", fmt::format("'{}'", name), near_value(name));
  }

  void add_material(const std::string& name) {
    const Element* element = find_element(document_, name);
    if (element == nullptr || !(is_node(*element) || element->category() == "output")) {
      diagnostics_.error("unknown-request", at_root(document_, name),
                         "the document has no such material", "the name of a material node",
                         fmt::format("'{}'", name),
                         near_hint(diagnostics_, name, find_materials(document_),
                                   [](auto& each) { return std::string_view(each.name); }));
      return;
    }
    const Resolved result = element->category() == "output"
                                ? resolver_.resolve_port(*element, context_around(*element))
                                : resolver_.resolve_node(*element, "");
    if (result.failed) return;
    if (result.type != Type::material) {
      diagnostics_.error("not-a-material", location(*element), "this is not a material",
                         "a node of type material", std::string(type_name(result.type)));
      return;
    }
    add_shaders(result.source, *element);
  }

  /// Everything in a scope, whether or not something reads it.
  void add_scope(const Element& scope, const Context* context) {
    for (const Element& child : scope.children()) {
      if (child.category() == "output") resolver_.resolve_port(child, context);
      if (!is_node(child)) continue;
      const NodeDef* def = resolver_.nodedef_of(child);
      if (def == nullptr) continue;
      for (const NodeDefOutput& output : def->outputs) {
        resolver_.resolve_node(child, output.name, context);
      }
    }
  }

  const Context* context_of(const Element& graph) {
    return graph.parent() == nullptr ? nullptr : resolver_.compound(graph, context_around(graph));
  }

  double fullness() const { return resolver_.fullness(); }

  Graph take() {
    prune(resolver_.graph());
    return std::move(resolver_.graph());
  }

 private:
  const Context* context_around(const Element& output) {
    // Graphs within graphs: one context for each, outermost first.
    std::vector<const Element*> graphs;
    for (const Element* at = output.parent(); at->parent() != nullptr; at = at->parent()) {
      graphs.push_back(at);
    }
    const Context* context = nullptr;
    for (const Element* graph : std::views::reverse(graphs)) {
      context = resolver_.compound(*graph, context);
    }
    return context;
  }

  /// What an output that there is not will have meant: one there is, or a node at the root.
  std::string near_output(const std::string& name) const {
    std::vector<std::string> known;
    for (const FoundOutput& each : find_outputs(document_)) known.push_back(each.name);
    for (const Element& each : document_.root().children()) {
      if (is_node(each) || each.category() == "nodegraph") known.emplace_back(each.name());
    }
    return near_hint(diagnostics_, name, known);
  }

  /// The same of a value: an output, a node, or a port that is written down.
  std::string near_value(const std::string& name) const {
    const std::size_t slash = name.rfind('/');
    const Element* scope = slash == std::string::npos
                               ? &document_.root()
                               : find_element(document_, name.substr(0, slash));
    if (scope == nullptr) return near_output(name);
    const std::string before = slash == std::string::npos ? "" : name.substr(0, slash + 1);
    return near_hint(diagnostics_, name, scope->children(),
                     [&](const Element& each) { return before + std::string(each.name()); });
  }

  /// Colours would be left as they are.
  void check_space(const char* option, const std::string& name) {
    if (name.empty() || name == "none" || resolver_.colors().is_known(name)) return;
    diagnostics_.error("unknown-colorspace", at_root(document_, option),
                       "there is no such colour space", "one built in, or of the configuration",
                       fmt::format("'{}'", name), resolver_.colors().near_space(name));
  }

  /// Lengths would be left as they are, of a document that has no other.
  void check_distance_unit(const std::string& name) {
    if (name == GraphOptions().distance_unit) return;  // What libraries without units have, too.
    const auto unit = definitions_.unit(name);
    if (unit && unit->type == "distance") return;
    diagnostics_.error("unknown-unit", at_root(document_, "distance_unit"),
                       "there is no such unit of length", "the name of a <unit> of distance",
                       fmt::format("'{}'", name),
                       near_hint(diagnostics_, name, definitions_.unit_names()));
  }

  void check_variant(const VariantChoice& choice) {
    const Element* set = document_.root().child(choice.variantset);
    const bool is_set = set != nullptr && set->category() == "variantset";
    const Element* variant = is_set ? set->child(choice.variant) : nullptr;
    if (variant != nullptr && variant->category() == "variant") return;
    diagnostics_.error(
        "unknown-variant", at_root(document_, choice.variantset),
        is_set ? "the variantset has no such variant" : "the document has no such variantset",
        is_set ? "the name of a <variant>" : "the name of a <variantset>",
        fmt::format("'{}'", is_set ? choice.variant : choice.variantset),
        near_hint(diagnostics_, is_set ? choice.variant : choice.variantset,
                  (is_set ? *set : document_.root()).children(), [&](const Element& each) {
                    return each.category() == (is_set ? "variant" : "variantset")
                               ? each.name()
                               : std::string_view();
                  }));
  }

  void report_several(const Element& element) {
    diagnostics_.error("output-required", location(element),
                       "the graph has several outputs and none is named", "GRAPH/NAME");
  }

  void add(const std::string& name, const Resolved& result, const Element& element) {
    if (result.failed) return;
    resolver_.graph().outputs.push_back({name, result.type, result.source, location(element)});
  }

  void add_node(const std::string& name, const Element& node) {
    const NodeDef* def = resolver_.nodedef_of(node);
    if (def == nullptr) return;
    for (const NodeDefOutput& output : def->outputs) {
      const bool is_only = def->outputs.size() == 1;
      const std::string full = is_only ? name : name + '/' + std::string(output.name);
      add(full, resolver_.in_output_space(resolver_.resolve_node(node, output.name), full, node),
          node);
    }
  }

  /// `port`: one of its outputs or inputs; "" for its only output.
  void add_value_of(const std::string& name, const Element& node, std::string_view port) {
    const NodeDef* def = resolver_.nodedef_of(node);
    if (def == nullptr) return;
    const auto input = std::ranges::find(def->inputs, port, &NodeDefInput::name);
    const Resolved found =
        input == def->inputs.end()
            ? resolver_.resolve_node(node, port, context_around(node))
            : resolver_.resolve_input(node, std::uint32_t(input - def->inputs.begin()),
                                      context_around(node));
    if (!found.failed && !is_numeric(found.type)) {
      diagnostics_.error("not-numeric", location(node), fmt::format("'{}' has no numbers", name),
                         "a numeric type", std::string(type_name(found.type)));
      return;
    }
    add(name, found, node);
  }

  // A material is its shaders; nodes that pass materials on are looked through.
  void add_shaders(Source source, const Element& element) {
    Graph& graph = resolver_.graph();
    while (source.kind == Source::Kind::link && graph.nodes[source.node].category == "dot" &&
           !graph.nodes[source.node].inputs.empty()) {
      Source next = graph.nodes[source.node].inputs[0].source;
      source = std::move(next);
    }
    const std::string_view category = source.kind == Source::Kind::link
                                          ? std::string_view(graph.nodes[source.node].category)
                                          : std::string_view{};
    if (!is_material_category(category)) {
      diagnostics_.error("not-a-material", location(element),
                         "the material leads to no <surfacematerial>, <volumematerial> or "
                         "<lightmaterial>");
      return;
    }
    const std::vector<GraphInput> inputs = graph.nodes[source.node].inputs;
    for (const GraphInput& input : inputs) {
      if (input.source.kind != Source::Kind::link) continue;
      graph.outputs.push_back({input.name, input.type, input.source, location(element)});
    }
  }

  const Document& document_;
  const Definitions& definitions_;
  Diagnostics& diagnostics_;
  Resolver resolver_;
  bool knows_options_ = false;
};

}  // namespace

std::optional<Graph> build_graph(const Document& document, const Definitions& definitions,
                                 const GraphRequest& request, const GraphOptions& options,
                                 Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  GraphBuild build(document, definitions, options, diagnostics);
  if (!build.knows_options()) return std::nullopt;
  for (const std::string& name : request.outputs) build.add_output(name);
  if (!request.material.empty()) build.add_material(request.material);
  for (const std::string& name : request.values) build.add_value(name);
  if (diagnostics.error_count() != errors) return std::nullopt;
  std::optional<Graph> graph = build.take();
  const auto named = [](const std::string& file) { return !file.empty(); };
  const auto main_file = std::ranges::find_if(document.files(), named);
  if (graph && main_file != document.files().end()) graph->document = *main_file;
  return graph;
}

void try_all_graphs(const Document& document, const Definitions& definitions,
                    const GraphOptions& options, Diagnostics& diagnostics) {
  // One build serves many, so that what they share is resolved once; it is renewed
  // before it could become too large for any single one.
  constexpr double most = 4;  // Times the limit of one graph, for all together.
  std::optional<GraphBuild> build;
  double done = 0;
  const auto renewed = [&]() -> GraphBuild& {
    if (!build || build->fullness() > 0.5) {
      done += build ? build->fullness() : 0;
      build.emplace(document, definitions, options, diagnostics);
    }
    return *build;
  };
  // Graphs of graphs meet the same fault once for each that stands on the faulty one.
  constexpr std::size_t most_errors = 200;
  const std::size_t errors = diagnostics.error_count();
  const auto is_hopeless = [&] {
    return build && (build->fullness() > 1 || done > most ||
                     diagnostics.error_count() - errors > most_errors);
  };
  if (!renewed().knows_options()) return;
  for (const FoundMaterial& material : find_materials(document)) {
    if (is_hopeless()) return;
    renewed().add_material(material.name);
  }
  std::vector<const Element*> scopes{&document.root()};
  while (!scopes.empty() && !is_hopeless()) {
    const Element& scope = *scopes.back();
    scopes.pop_back();
    GraphBuild& current = renewed();
    current.add_scope(scope, current.context_of(scope));
    const std::size_t first = scopes.size();
    for (const Element& child : scope.children()) {
      if (child.category() == "nodegraph") scopes.push_back(&child);
    }
    std::reverse(scopes.begin() + static_cast<std::ptrdiff_t>(first), scopes.end());
  }
  if (diagnostics.error_count() - errors > most_errors) {
    diagnostics.warning("too-many-errors", location(document.root()),
                        "there are so many errors that the rest of the graphs is not looked at",
                        fmt::format("at most {}", most_errors));
  }
  if (done > most) {
    diagnostics.error("too-many-nodes", location(document.root()),
                      "all graphs of the document together have too many nodes",
                      fmt::format("at most {}", most * static_cast<double>(options.max_nodes)));
  }
}

std::optional<Graph> build_graph(const Document& document, const Library& library,
                                 const GraphRequest& request, const GraphOptions& options,
                                 Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const std::size_t errors = diagnostics.error_count();
  const Definitions definitions(document, &library.definitions(), diagnostics);
  if (diagnostics.error_count() != errors) return std::nullopt;
  return build_graph(document, definitions, request, options, diagnostics);
}

}  // namespace nacre
