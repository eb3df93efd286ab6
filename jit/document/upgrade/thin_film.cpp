#include <array>
#include <unordered_map>
#include <unordered_set>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

bool has_film_inputs(const Element& node) {
  return node.category() == "dielectric_bsdf" || node.category() == "conductor_bsdf" ||
         node.category() == "generalized_schlick_bsdf";
}

/// A film of one graph on its way into the closures that it covers.
class Films {
 public:
  Films(const Upgrade& upgrade, Scope& scope)
      : upgrade_(upgrade), document_(upgrade.document), scope_(scope) {}

  void replace_all() {
    for (Element* node : scope_.children()) {
      if (node->category() == "layer") replace_layer(*node);
    }
    if (!bypass_.empty()) reconnect();
    for (Element* film : films_) scope_.remove(*film);
  }

 private:
  Element* source(Element& node, std::string_view input_name) {
    const Element* input = input_of(node, input_name);
    return input != nullptr ? find(input->attribute("nodename")) : nullptr;
  }

  void replace_layer(Element& layer) {
    Element* film = source(layer, "top");
    if (film == nullptr || film->category() != "thin_film_bsdf") return;
    Element* base = source(layer, "base");
    if (base == nullptr || has_own_nodedef(upgrade_, *film)) return;
    cover(*film, layer);
    bypass_.emplace(layer.name(), base->name());
    scope_.remove(layer);
    films_.insert(film);
  }

  /// Gives the film to every closure that the layer's inputs lead to.
  void cover(Element& film, Element& layer) {
    std::unordered_set<const Element*> seen{&layer, &film};
    std::vector<Element*> open{&layer};
    while (!open.empty()) {
      Element& node = *open.back();
      open.pop_back();
      // Films over films over films are a way to exhaust the machine.
      if (!upgrade_.spend(1 + node.child_count() + film.child_count(), layer)) return;
      if (has_film_inputs(node)) apply(film, node);
      for (const Element* input : children_of(node)) {
        if (input->category() != "input") continue;
        if (input->attribute("type") == "BSDF" && input->has_attribute("nodegraph")) {
          cannot_upgrade(upgrade_, *input, "a closure of another graph lies below a thin film",
                         "a node beside the film");
        }
        Element* below = find(input->attribute("nodename"));
        if (below != nullptr && seen.insert(below).second) open.push_back(below);
      }
    }
  }

  // Layers that were taken out already still lead to what is below them.
  Element* find(std::string_view name) { return scope_.find(passed(name)); }

  void apply(Element& film, Element& node) {
    const Element* mode = input_of(node, "scatter_mode");
    if (mode != nullptr && mode->attribute("value") == "T") return;
    // A film had 550 nm if nothing was said; a closure has none.
    bind(film, "thickness", node, "thinfilm_thickness", "550");
    bind(film, "ior", node, "thinfilm_ior", "1.5");
  }

  void bind(Element& film, std::string_view from, Element& node, std::string_view to,
            std::string_view otherwise) {
    Element* input = input_of(node, to);
    if (input == nullptr) input = &add_input(document_, node, to, "float", film);
    if (const Element* given = input_of(film, from)) {
      copy_binding(document_, *given, *input);
    } else {
      document_.set_attribute(*input, "value", otherwise);
    }
  }

  /// The node below the layers taken out that a name leads through.
  std::string_view passed(std::string_view name) {
    std::vector<std::string_view*> path;
    for (auto at = bypass_.find(name); at != bypass_.end() && path.size() <= bypass_.size();
         at = bypass_.find(name)) {
      name = at->second;
      path.push_back(&at->second);
    }
    for (std::string_view* base : path) *base = name;
    return name;
  }

  /// What read a layer reads what was below it.
  void reconnect() {
    for (Element* port : ports_of(scope_.graph())) {
      if (!bypass_.contains(port->attribute("nodename"))) continue;
      document_.set_attribute(*port, "nodename", passed(port->attribute("nodename")));
    }
  }

  const Upgrade& upgrade_;
  Document& document_;
  Scope& scope_;
  std::unordered_map<std::string_view, std::string_view> bypass_;  // layer to base
  std::unordered_set<Element*> films_;
};

void report_the_rest(const Upgrade& upgrade, Element& graph) {
  for (const Element* node : children_of(graph)) {
    if (node->category() != "thin_film_bsdf" || has_own_nodedef(upgrade, *node)) continue;
    cannot_upgrade(upgrade, *node,
                   "thin_film_bsdf is no more, and this one is not the top of a layer whose base "
                   "is a node beside it",
                   "inputs thinfilm_thickness and thinfilm_ior of the closure below");
  }
}

}  // namespace

void replace_thin_film(const Upgrade& upgrade) {
  for (Element* graph : graphs_of(upgrade.root)) {
    Scope scope(upgrade.document, *graph);
    Films(upgrade, scope).replace_all();
    scope.finish();
    report_the_rest(upgrade, *graph);
  }
}

}  // namespace nacre::upgrading
