#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "jit/document/element.h"
#include "runtime/diagnostic.h"
#include "runtime/type.h"
#include "runtime/value.h"

namespace nacre {

/// The leaf of a structure that a port is; for other ports `port` is the port's name.
struct PortMember {
  std::string_view port;         ///< "in" of the port "in.ss".
  std::string_view struct_type;  ///< Name of the `<typedef>`; "" if the port is no leaf.
  std::uint32_t leaf = 0;        ///< 1 + its number among the leaves; 0: the port is no leaf.
};

/// One input of a nodedef; of a structure, one leaf of it.
struct NodeDefInput {
  /// "in", "in.ss" for a leaf.
  std::string_view name;
  /// None for a type the standard does not have (see `type_text`).
  Type type = Type::none;
  std::string_view type_text;  ///< As the nodedef has it: "color3".
  /// The default; zero, or nothing for closures and shaders, where the nodedef
  /// gives none (`has_default`).
  Value default_value;
  bool has_default = false;          ///< The nodedef gives a default that fits the type.
  std::string_view defaultgeomprop;  ///< "UV0", "Nworld"; "" if none.
  bool uniform = false;              ///< Never varies over a surface, as texts and arrays do not.
  std::vector<std::string_view> enums;  ///< Allowed strings; labels for other types.
  std::string_view enum_values;         ///< Values of `enums`, as written.
  /// What the node takes numbers in: "degree"; "" if it does not say.
  std::string_view unit;
  /// "distance", "angle"; "" for numbers without.
  std::string_view unit_type;
  std::string_view colorspace;  ///< Of the default: nearest up the tree.
  PortMember member;            ///< What port of an instance it belongs to.
  /// For `doc`, `uiname`, `uimin`, `uisoftmax`, `uifolder` and the like.
  const Element* element = nullptr;
};

/// What a host shows of an input (Specification, "Standard UI Attributes"). Texts are
/// "" and values of type none where the nodedef says nothing.
struct InputUi {
  std::string_view label;   ///< uiname
  std::string_view folder;  ///< uifolder: "Base/Diffuse"
  std::string_view doc;     ///< What it is for, in a sentence.
  /// uimin, uimax: what makes sense.
  /// @{
  Value min, max;
  /// @}
  /// uisoftmin, uisoftmax: what a slider shows.
  /// @{
  Value soft_min, soft_max;
  /// @}
  Value step;             ///< uistep
  bool advanced = false;  ///< uiadvanced
};
/// From the attributes of the input's element; values that do not fit its type are type none.
InputUi ui_of(const NodeDefInput& input);

/// One choice of an input.
struct EnumChoice {
  std::string_view label;  ///< What people see.
  Value value;  ///< What it stands for; the label itself where the nodedef gives no enumvalues.
};
/// The choices of an input, in the nodedef's order; empty without an enumeration.
std::vector<EnumChoice> enum_choices(const NodeDefInput& input);

/// One output of a nodedef; of a structure, one leaf of it.
struct NodeDefOutput {
  std::string_view name;       ///< "out", "out.ss" for a leaf.
  Type type = Type::none;      ///< None for a type the standard does not have.
  std::string_view type_text;  ///< As the nodedef has it.
  Value default_value;       ///< What it gives where nothing implements the node; zero if not said.
  bool has_default = false;  ///< The nodedef gives a default that fits the type.
  std::string_view default_geomprop;  ///< The default is this geometric property; "" if not.
  std::string_view defaultinput;  ///< Input that passes through when nothing implements the node.
  PortMember member;              ///< What port of an instance it belongs to.
  const Element* element = nullptr;  ///< The `<output>` itself.
};

/// The signature of a node, with what it inherits merged in. Its texts point
/// into the document that declares it.
struct NodeDef {
  std::string_view name;               ///< "ND_mix_color3"
  std::string category;                ///< "mix", or "ns:mix" in a namespace.
  std::string_view nodegroup;          ///< "compositing"; "" if not said.
  std::string_view version;            ///< "" for a nodedef without versions.
  bool is_default_version = false;     ///< Taken by instances that name no version.
  std::string_view target;             ///< "" for all; may be a list.
  std::vector<NodeDefInput> inputs;    ///< Own ones in their order, then inherited ones.
  std::vector<NodeDefOutput> outputs;  ///< Own ones in their order, then inherited ones.
  const Element* element = nullptr;    ///< The `<nodedef>` itself.

  /// The input of that name, or null.
  const NodeDefInput* input(std::string_view wanted) const;
  /// The output of that name, or null.
  const NodeDefOutput* output(std::string_view wanted) const;
  /// Type that an instance's input of that name has, structures included; "" if there
  /// is no such input.
  std::string_view input_type(std::string_view port) const;
  /// Type of an instance: that of the only output, else "multioutput".
  std::string_view instance_type() const;
};

/// Reads a `<nodedef>` without what it inherits. Faults become diagnostics and
/// leave the port with type none or without its default.
NodeDef read_nodedef(const Element& element, Diagnostics& diagnostics);

/// Adds the inputs and outputs of `base` that `derived` does not have.
void inherit_ports(NodeDef& derived, const NodeDef& base);

/// Splits at commas and trims.
std::vector<std::string_view> split_list(std::string_view text);

}  // namespace nacre
