#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/type.h"

namespace nacre {

/// A `<typedef>` with members (MaterialX 1.39 Specification, "Custom Data Types"), members
/// that are structures themselves replaced by theirs. A port of such a type is one port
/// for each leaf, called PORT.MEMBER: a structure flows as its leaves, side by side.
struct StructType {
  /// A member that is no structure itself.
  struct Leaf {
    std::string path;          ///< ".ss", ".st_0.ss"
    Type type = Type::none;    ///< Of its values.
    std::string default_text;  ///< What the member's `value` says; "" if nothing.
  };
  /// As ports name the type.
  std::string_view name;
  /// In the order in which values list them.
  std::vector<Leaf> leaves;
};

/// The leaves of "{a; b; {c; d}}", trimmed. Nothing if braces do not match.
std::optional<std::vector<std::string_view>> split_struct_value(std::string_view text);

}  // namespace nacre
