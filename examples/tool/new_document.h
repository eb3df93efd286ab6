#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "jit/document/document.h"

namespace nacre::tool {

/// A document in the making, in lin_rec709. It keeps the texts that it is given.
class NewDocument {
 public:
  NewDocument();

  Element& root() { return *root_; }
  /// An element that stands nowhere yet.
  Element& make(std::string_view category, std::string_view name, std::string_view type = {});
  /// A copy of an element and all within; it stands nowhere yet.
  Element& copy_of(const Element& element);
  void append(Element& parent, Element& child) { document_.append(parent, child); }
  Element& add_input(Element& node, std::string_view name, std::string_view type);
  void set(Element& element, std::string_view name, std::string_view value);
  /// The name, or with a number where it was asked for before.
  std::string free_name(const std::string& wanted);
  /// The XML.
  std::string text() const;

 private:
  Document document_;
  Element* root_;
  std::unordered_map<std::string, int> names_;
};

}  // namespace nacre::tool
