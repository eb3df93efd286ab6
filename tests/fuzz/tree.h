#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nacre::fuzz {

/// An XML element that belongs to no document, so that parts can be exchanged freely.
/// Values are as they were written, entities and all; text between elements is dropped.
struct Tree {
  std::string category;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Tree> children;

  /// Null without it.
  const std::string* find(std::string_view name) const;
  void set(std::string_view name, std::string_view value);
};

/// The root element of a text; nothing if it is not XML or nests deeper than 100.
std::optional<Tree> read_tree(std::string_view text);

/// Well-formed whatever the tree holds, as long as its names are names.
std::string write_tree(const Tree& tree);

/// The element and all below it, itself first.
std::vector<Tree*> all_elements(Tree& tree);
std::vector<const Tree*> all_elements(const Tree& tree);

}  // namespace nacre::fuzz
