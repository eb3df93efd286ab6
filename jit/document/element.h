#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <string_view>

#include "runtime/diagnostic.h"

namespace nacre {

class Document;
class Element;

/// An attribute of an element. Both texts live as long as the document; references of XML are
/// resolved.
struct Attribute {
  std::string_view name;   ///< "nodename", as the file has it.
  std::string_view value;  ///< What stands between the quotes.
};

/// The children of an element in document order.
class ElementRange {
 public:
  /// A forward iterator over siblings.
  class Iterator {
   public:
    /// What std::iterator_traits asks for.
    /// @{
    using iterator_category = std::forward_iterator_tag;
    using value_type = const Element;
    using difference_type = std::ptrdiff_t;
    using pointer = const Element*;
    using reference = const Element&;
    /// @}

    /// The end.
    Iterator() = default;
    /// At an element; null: the end.
    explicit Iterator(const Element* at) : at_(at) {}
    /// Not at the end.
    const Element& operator*() const { return *at_; }
    /// Not at the end.
    const Element* operator->() const { return at_; }
    /// To the next sibling; not at the end.
    Iterator& operator++();
    /// To the next sibling; returns where it was.
    Iterator operator++(int);
    bool operator==(const Iterator&) const = default;

   private:
    const Element* at_ = nullptr;
  };

  /// The element and its later siblings; null: none.
  explicit ElementRange(const Element* first) : first_(first) {}
  /// For range-based loops.
  /// @{
  Iterator begin() const { return Iterator(first_); }
  Iterator end() const { return Iterator(nullptr); }
  /// @}

 private:
  const Element* first_;
};

/// One XML element of a document. Elements live in their Document, never move,
/// and their text points into it.
class Element {
 public:
  /// The tag: "nodegraph", "mix", "ns:mycategory".
  std::string_view category() const { return category_; }
  /// The `name` attribute; "" without one. "ns:name" if it came through an
  /// include from a document with a namespace.
  std::string_view name() const { return name_; }
  /// In the order of the file.
  std::span<const Attribute> attributes() const { return {attributes_, attribute_count_}; }
  /// Value of an attribute; "" if it is not there.
  std::string_view attribute(std::string_view name) const;
  /// Tells an attribute that is "" from none.
  bool has_attribute(std::string_view name) const;
  /// An attribute of this element or of its nearest ancestor that has it; "".
  std::string_view inherited_attribute(std::string_view name) const;

  /// Null for the root.
  const Element* parent() const { return parent_; }
  /// The sibling behind it, or null.
  const Element* next() const { return next_; }
  /// In document order.
  ElementRange children() const { return ElementRange(first_child_); }
  /// Of its own, not of theirs.
  std::size_t child_count() const { return child_count_; }
  /// The child of that name, or null. Constant time in large scopes.
  const Element* child(std::string_view name) const;

  /// The document that owns this element.
  const Document& document() const { return *document_; }

 private:
  friend class Document;
  std::string_view category_;
  std::string_view name_;
  const Attribute* attributes_ = nullptr;
  Document* document_ = nullptr;
  Element* parent_ = nullptr;
  Element* first_child_ = nullptr;
  Element* last_child_ = nullptr;
  Element* next_ = nullptr;
  std::uint32_t attribute_count_ = 0;
  std::uint32_t child_count_ = 0;
  std::uint32_t offset_ = 0;  // of the tag in its file
  std::uint16_t file_ = 0;
  bool indexed_ = false;  // the document holds a name table of the children
};

inline ElementRange::Iterator& ElementRange::Iterator::operator++() {
  at_ = at_->next();
  return *this;
}

inline ElementRange::Iterator ElementRange::Iterator::operator++(int) {
  Iterator before = *this;
  ++*this;
  return before;
}

/// File, line, column and element path, for a diagnostic.
SourceLocation location(const Element& element);

/// Names from below the root down, joined with '/': "NG_marble/mix1/fg". An
/// element without a name stands as its category.
std::string element_path(const Element& element);

/// "ns:name" where the element or an ancestor sets `namespace`; `name` itself
/// where none does or the prefix is there already.
std::string qualified_name(const Element& element, std::string_view name);

}  // namespace nacre
