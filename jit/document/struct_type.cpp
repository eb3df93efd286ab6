#include "jit/document/struct_type.h"

#include "jit/document/value_text.h"

namespace nacre {

std::optional<std::vector<std::string_view>> split_struct_value(std::string_view text) {
  text = trim(text);
  if (!text.starts_with('{') || !text.ends_with('}')) return std::nullopt;
  // Nesting says nothing that the order of the leaves does not: braces only have to match.
  std::vector<std::string_view> leaves;
  int depth = 0;
  bool closed = false;  // the last leaf ended with its braces
  std::size_t first = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c != '{' && c != '}' && c != ';') continue;
    const std::string_view leaf = trim(text.substr(first, i - first));
    if (c == '{') {
      if (!leaf.empty()) return std::nullopt;
      ++depth;
    } else if (!closed) {
      leaves.push_back(leaf);
    } else if (!leaf.empty()) {
      return std::nullopt;
    }
    closed = c == '}';
    if (c == '}' && --depth < 0) return std::nullopt;
    if (depth == 0 && i + 1 != text.size()) return std::nullopt;
    first = i + 1;
  }
  if (depth != 0) return std::nullopt;
  return leaves;
}

}  // namespace nacre
