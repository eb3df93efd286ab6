#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "jit/document/document.h"

namespace nacre::upgrading {

/// The children of a document root or node graph while nodes are added, removed
/// and renamed. The graph is changed when `finish` is called; what is added stands
/// before the node it was added for, so sources stay in front of their readers.
class Scope {
 public:
  Scope(Document& document, Element& graph);

  Element& graph() { return graph_; }
  /// The children there were at first, without those removed since.
  std::vector<Element*> children() const;
  /// By name, added ones too; null if there is none.
  Element* find(std::string_view name) const;
  /// `wanted`, or with the next free number at its end.
  std::string free_name(std::string_view wanted) const;

  /// A node of that type called free_name(wanted), before `user` and placed there.
  Element& add_node(std::string_view category, std::string_view wanted, std::string_view type,
                    const Element& user);
  /// The same behind `source`, a child of the graph.
  Element& add_node_after(std::string_view category, std::string_view wanted, std::string_view type,
                          const Element& source);
  /// As add_node, for an element that has its name and no parent any more.
  void adopt(Element& element, const Element& user);
  void remove(Element& child);
  void rename(Element& child, std::string_view name);
  void finish();

 private:
  Document& document_;
  Element& graph_;
  std::unordered_map<std::string_view, Element*> names_;
  std::unordered_map<const Element*, std::vector<Element*>> added_;   // by the child they precede
  std::unordered_map<const Element*, std::vector<Element*>> behind_;  // by the child they follow
  std::unordered_map<const Element*, const Element*> anchors_;        // of what was added
  std::unordered_set<const Element*> removed_;
  mutable std::unordered_map<std::string, int> numbers_;  // the last one tried, by stem
};

}  // namespace nacre::upgrading
