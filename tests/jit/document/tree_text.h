#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "jit/document/document.h"

namespace nacre {

/// A tree as lines, for comparing: categories, attributes sorted by name.
inline void append_tree(std::string& text, const Element& element, int level) {
  std::vector<Attribute> attributes(element.attributes().begin(), element.attributes().end());
  std::sort(attributes.begin(), attributes.end(),
            [](const Attribute& a, const Attribute& b) { return a.name < b.name; });
  text.append(static_cast<std::size_t>(2 * level), ' ');
  text += element.category();
  for (const Attribute& attribute : attributes) {
    const bool is_name = attribute.name == "name";
    text += ' ';
    text += attribute.name;
    text += "='";
    text += is_name ? element.name() : attribute.value;
    text += '\'';
  }
  text += '\n';
  for (const Element& child : element.children()) append_tree(text, child, level + 1);
}

inline std::string tree_text(const Document& document) {
  std::string text;
  append_tree(text, document.root(), 0);
  return text;
}

}  // namespace nacre
