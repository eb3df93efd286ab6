#pragma once

#include <functional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre::upgrading {

/// One file under upgrade, for the steps of jit/document/upgrade/.
struct Upgrade {
  Document& document;
  Element& root;
  Diagnostics& diagnostics;
  /// The nodedefs at the root of the file, by name.
  std::unordered_map<std::string_view, Element*> nodedefs;
  /// The same by the category they define, in document order.
  std::unordered_map<std::string_view, std::vector<Element*>> nodedefs_of;

  Upgrade(Document& document_, Element& root_, Diagnostics& diagnostics_)
      : document(document_), root(root_), diagnostics(diagnostics_) {}
  /// Looks for the nodedefs again.
  void find_nodedefs();
  /// Counts steps whose number may be the square of the file's size. False, with
  /// an error at `where` the first time, once there were too many.
  bool spend(std::size_t steps, const Element& where) const;

 private:
  mutable std::size_t spent_ = 0;
};

/// All elements of the file, parents before children, as they are now.
std::vector<Element*> elements_of(Element& root);
/// The root and every <nodegraph> below it, outer ones first.
std::vector<Element*> graphs_of(Element& root);
std::vector<Element*> children_of(Element& parent);
std::unordered_set<std::string_view> names_of(Element& parent);
/// Of that name and category, or null.
Element* child_of(Element& parent, std::string_view category, std::string_view name);
/// Of that name and any category, or null.
Element* child_named(Element& parent, std::string_view name);
Element* input_of(Element& node, std::string_view name);

/// The inputs of nodes, nested graphs and shader references in a graph, and its
/// outputs: what may name a node of that graph.
std::vector<Element*> ports_of(Element& graph);

/// Takes those children out that `is_gone` is true for.
void remove_children(Document& document, Element& parent,
                     const std::function<bool(const Element&)>& is_gone);
void remove_child(Document& document, Element& parent, const Element& child);
void move_attribute(Document& document, Element& element, std::string_view from,
                    std::string_view to);
/// Changes the name of an element and its `name` attribute; both texts are kept.
void rename(Document& document, Element& element, std::string_view name);
void set_kept(Document& document, Element& element, std::string_view attribute,
              std::string_view value);
/// An <input> of a node, placed where `place` was written. Texts are kept.
Element& add_input(Document& document, Element& node, std::string_view name, std::string_view type,
                   const Element& place);
/// Gives `to` what `from` is bound to: value, connection or interface, with the
/// attributes that say how a value is meant (colorspace, unit, unittype, channels).
void copy_binding(Document& document, const Element& from, Element& to);
/// True if anything but a value feeds the port.
bool is_connected(const Element& port);
/// Takes all connections and values from a port and connects it to a node.
void connect(Document& document, Element& port, const Element& node);

/// Sets `nodedef` to `standard` where the node names one, unless the file itself
/// defines what it names.
void rename_nodedef(const Upgrade& upgrade, Element& node, std::string_view standard);
/// True if the node names a nodedef that the file itself holds: then it is not
/// the standard's node, whatever its category.
bool has_own_nodedef(const Upgrade& upgrade, const Element& node);

/// Reports that an element has no equivalent in 1.39.
void cannot_upgrade(const Upgrade& upgrade, const Element& element, std::string_view why,
                    std::string_view expected = {});

}  // namespace nacre::upgrading
