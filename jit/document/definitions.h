#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "jit/document/document.h"
#include "jit/document/nodedef.h"
#include "jit/document/struct_type.h"

namespace nacre {

/// The target whose nodedefs and implementations are taken: those that name no
/// target, and those that name this one.
inline constexpr std::string_view own_target = "nacre";
/// The target whose implementations by text are in a language that runs here.
inline constexpr std::string_view source_target = "genglsl";

/// What a document declares for others to use, found by name. A user document's
/// definitions stand on the library's, which are searched first (Document::
/// setDataLibrary of the reference).
class Definitions {
 public:
  /// `document` and `base` must outlive it. Faults of the document's nodedefs
  /// (bad default, inheritance from nowhere or in a circle) are reported.
  Definitions(const Document& document, const Definitions* base, Diagnostics& diagnostics);

  /// By unique name, "ND_mix_color3"; null if there is none.
  const NodeDef* nodedef(std::string_view name) const;
  /// All of a qualified category, library first, then in document order.
  std::vector<const NodeDef*> of_category(std::string_view category) const;
  /// All there are, library first, then in document order.
  std::vector<const NodeDef*> all() const;

  /// The `<nodegraph>` that implements a nodedef, named by the graph's `nodedef`
  /// or by an `<implementation>`; null if there is none.
  const Element* graph_of(const NodeDef& def) const;

  /// The `<implementation>` that gives a nodedef by text: an attribute `file` with
  /// a function of the GLSL subset, or `sourcecode`, for our target, for none, or
  /// for MaterialX's own GLSL generator. Null if there is none.
  const Element* text_of(const NodeDef& def) const;

  /// What the document has to implement a nodedef of the library here: graphs, and
  /// `<implementation>`s that name one or have a text. The library's own go before them.
  std::span<const Element* const> replacements(const NodeDef& def) const;

  /// The nodedef that a `<nodegraph>` implements, named by it or by an `<implementation>`,
  /// for whatever target; null for a compound graph.
  const NodeDef* implemented_by(const Element& graph) const;

  /// The `<typedef>` of that name if it has members, or null.
  const StructType* struct_type(std::string_view name) const;

  /// The `<geompropdef>` of that name, or null.
  const Element* geompropdef(std::string_view name) const;

  /// Size of a unit in the base unit of its type: 0.01 for "centimeter".
  struct Unit {
    std::string_view type;  ///< "distance", "angle"
    double scale = 1;       ///< Base units in one of it.
  };
  /// By its name in a document; nothing for one that no unit definition has.
  std::optional<Unit> unit(std::string_view name) const;

  /// Names of all that there are of these, the library's too, in no order.
  /// @{
  std::vector<std::string_view> unit_names() const;
  std::vector<std::string_view> geompropdef_names() const;
  /// @}

  /// Element at the root by a reference made in `user`: in its namespace first,
  /// then as it is, in the library and then in the document.
  const Element* resolve(std::string_view name, const Element& user) const;

 private:
  void read_structs(Diagnostics& diagnostics);
  bool add_leaves(const Element& definition, const std::string& path, int depth,
                  StructType& type) const;
  void expand_structs(NodeDef& def, Diagnostics& diagnostics);
  void read_nodedefs(Diagnostics& diagnostics);
  void apply_inheritance(Diagnostics& diagnostics);
  void read_implementations(Diagnostics& diagnostics);
  void read_implementation(const Element& element, Diagnostics& diagnostics);
  void note_replacement(const NodeDef& def, const Element& implementation);
  void read_units(Diagnostics& diagnostics);
  bool is_of_base(const Element& element) const;
  void warn_of_shadow(const Element& element, std::string_view what,
                      Diagnostics& diagnostics) const;
  const NodeDef* resolve_nodedef(std::string_view name, const Element& user) const;

  const Document& document_;
  const Definitions* base_;
  std::deque<NodeDef> nodedefs_;
  std::deque<std::string> texts_;  ///< Names and types of leaves.
  std::unordered_map<std::string_view, StructType> structs_;
  std::unordered_map<std::string_view, NodeDef*> by_name_;
  std::unordered_map<std::string_view, std::vector<const NodeDef*>> by_category_;
  std::unordered_map<const NodeDef*, const Element*> graphs_;
  std::unordered_map<const NodeDef*, const Element*> sources_;
  std::unordered_map<const NodeDef*, std::vector<const Element*>> replacements_;
  std::unordered_map<const Element*, const NodeDef*> implemented_;
  std::unordered_map<std::string_view, const Element*> geompropdefs_;
  std::unordered_map<std::string_view, Unit> units_;
};

/// True if a target list is empty or holds `target`.
bool is_for_us(std::string_view targets, std::string_view target = own_target);

}  // namespace nacre
