// What implements nodedefs.
#include <fmt/format.h>

#include "jit/document/read.h"
#include "jit/graph/check/parts.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

class ImplementationCheck : ElementCheck {
 public:
  ImplementationCheck(const Document& document, const Definitions& definitions, bool lenient,
                      Diagnostics& diagnostics)
      : ElementCheck(diagnostics, lenient), document_(document), definitions_(definitions) {}

  void run() {
    for (const Element& child : document_.root().children()) {
      if (child.category() == "implementation") check_implementation(child);
      if (child.category() == "nodegraph" && child.has_attribute("nodedef")) check_only_one(child);
    }
  }

 private:
  void check_implementation(const Element& element) {
    const std::string_view name = element.attribute("nodedef");
    if (name.empty()) {
      // With a target alone it is a remark (as the data library has them).
      if (!element.has_attribute("nodegraph")) return;
      error("missing-nodedef", element, "the implementation does not say of what",
            "nodedef=\"NAME\"");
    }
    const NodeDef* def = named_nodedef(element);
    if (!name.empty() && def == nullptr) {
      tolerable("unknown-nodedef", element, "the nodedef to implement does not exist",
                "nothing can use it", "the name of a nodedef", in_quotes(name),
                near_hint(diagnostics_, name, definitions_.all(),
                          [](const NodeDef* each) { return each->name; }));
    }
    if (def != nullptr) check_renamed_ports(element, *def);
    const std::string_view graph = element.attribute("nodegraph");
    if (graph.empty()) return;
    const Element* found = definitions_.resolve(graph, element);
    if (found == nullptr || found->category() != "nodegraph") {
      error("unknown-nodegraph", element, "there is no node graph of this name",
            "the name of a node graph", in_quotes(graph),
            near_hint(diagnostics_, graph, element.document().root().children(),
                      [](const Element& each) {
                        return each.category() == "nodegraph" ? each.name() : std::string_view();
                      }));
      return;
    }
    check_only_one(element);
  }

  void check_renamed_ports(const Element& element, const NodeDef& def) {
    for (const Element& child : element.children()) {
      if (child.category() != "input" || !def.input_type(child.name()).empty()) continue;
      error("unknown-input", child, fmt::format("'{}' has no input of this name", def.name),
            "the name of an input", in_quotes(child.name()),
            near_hint(diagnostics_, child.name(), def.inputs,
                      [](const NodeDefInput& input) { return input.name; }));
    }
  }

  // Of several graphs for one nodedef the first counts, those of libraries before all.
  void check_only_one(const Element& element) {
    const NodeDef* def = named_nodedef(element);
    if (def == nullptr || !is_for_us(element.attribute("target"))) return;
    const Element* own = element.category() == "nodegraph"
                             ? &element
                             : definitions_.resolve(element.attribute("nodegraph"), element);
    const Element* used = definitions_.graph_of(*def);
    if (used == nullptr || used == own) return;
    warning("ambiguous-implementation", element,
            fmt::format("'{}' has another implementation, which is used instead", def->name),
            "one for each nodedef", in_quotes(used->name()));
  }

  const NodeDef* named_nodedef(const Element& element) const {
    const std::string_view name = element.attribute("nodedef");
    const NodeDef* def = definitions_.nodedef(qualified_name(element, name));
    return def != nullptr ? def : definitions_.nodedef(name);
  }

  const Document& document_;
  const Definitions& definitions_;
};

}  // namespace

void check_implementations(const Document& document, const Definitions& definitions, bool lenient,
                           Diagnostics& diagnostics) {
  ImplementationCheck(document, definitions, lenient, diagnostics).run();
}

}  // namespace nacre
