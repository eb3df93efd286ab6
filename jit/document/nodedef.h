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
  std::string_view port;  ///< "in" of the port "in.ss".
  std::string_view struct_type;
  std::uint32_t leaf = 0;  ///< 1 + its number among the leaves; 0: the port is no leaf.
};

struct NodeDefInput {
  std::string_view name;
  /// None for a type the standard does not have (see `type_text`).
  Type type = Type::none;
  std::string_view type_text;
  /// The default; zero, or nothing for closures and shaders, where the nodedef
  /// gives none (`has_default`).
  Value default_value;
  bool has_default = false;
  std::string_view defaultgeomprop;  ///< "UV0", "Nworld"; "" if none.
  bool uniform = false;
  std::vector<std::string_view> enums;  ///< Allowed strings; labels for other types.
  std::string_view enum_values;         ///< Values of `enums`, as written.
  std::string_view unit;
  std::string_view unit_type;
  std::string_view colorspace;  ///< Of the default: nearest up the tree.
  PortMember member;
  /// For `doc`, `uiname`, `uimin`, `uisoftmax`, `uifolder` and the like.
  const Element* element = nullptr;
};

/// What a host shows of an input (Specification, "Standard UI Attributes"). Texts are
/// "" and values of type none where the nodedef says nothing.
struct InputUi {
  std::string_view label;   ///< uiname
  std::string_view folder;  ///< uifolder: "Base/Diffuse"
  std::string_view doc;
  Value min, max;            ///< uimin, uimax: what makes sense.
  Value soft_min, soft_max;  ///< uisoftmin, uisoftmax: what a slider shows.
  Value step;                ///< uistep
  bool advanced = false;     ///< uiadvanced
};
InputUi ui_of(const NodeDefInput& input);

/// The choices of an input: labels, each with the value it stands for, which is the
/// label itself where the nodedef gives no enumvalues. Empty without an enumeration.
struct EnumChoice {
  std::string_view label;
  Value value;
};
std::vector<EnumChoice> enum_choices(const NodeDefInput& input);

struct NodeDefOutput {
  std::string_view name;
  Type type = Type::none;
  std::string_view type_text;
  Value default_value;
  bool has_default = false;
  std::string_view default_geomprop;  ///< The default is this geometric property; "" if not.
  std::string_view defaultinput;  ///< Input that passes through when nothing implements the node.
  PortMember member;
  const Element* element = nullptr;
};

/// The signature of a node, with what it inherits merged in. Its texts point
/// into the document that declares it.
struct NodeDef {
  std::string_view name;  ///< "ND_mix_color3"
  std::string category;   ///< "mix", or "ns:mix" in a namespace.
  std::string_view nodegroup;
  std::string_view version;
  bool is_default_version = false;
  std::string_view target;  ///< "" for all; may be a list.
  std::vector<NodeDefInput> inputs;
  std::vector<NodeDefOutput> outputs;
  const Element* element = nullptr;

  const NodeDefInput* input(std::string_view wanted) const;
  const NodeDefOutput* output(std::string_view wanted) const;
  /// Type that an instance's input of that name has, structures included; "" if there
  /// is no such input.
  std::string_view input_type(std::string_view port) const;
  /// Type of an instance: that of the only output, else "multioutput".
  std::string_view instance_type() const;
};

/// Reads a <nodedef> without what it inherits. Faults become diagnostics and
/// leave the port with type none or without its default.
NodeDef read_nodedef(const Element& element, Diagnostics& diagnostics);

/// Adds the inputs and outputs of `base` that `derived` does not have.
void inherit_ports(NodeDef& derived, const NodeDef& base);

/// Splits at commas and trims.
std::vector<std::string_view> split_list(std::string_view text);

}  // namespace nacre
