#pragma once

#include <nacre/nacre.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/api/text_arena.h"
#include "jit/document/document.h"

namespace nacre::api {

/// The elements of a document as hosts see them: one list, in the document's order.
class ElementList {
 public:
  /// Copies all texts; the document must outlive it.
  explicit ElementList(const Document& document);

  std::size_t size() const { return rows_.size(); }
  nacre_element element(std::size_t index) const;
  /// Name and value; nothing behind the last.
  std::pair<const char*, const char*> attribute(std::size_t element, std::size_t index) const;
  /// Null if the element does not have it.
  const char* find_attribute(std::size_t element, std::string_view name) const;
  /// SIZE_MAX if there is none.
  std::size_t find(std::string_view path) const;

 private:
  struct Row {
    const Element* element = nullptr;
    const char* category = "";
    const char* name = "";
    std::size_t parent = SIZE_MAX;
    std::size_t end = 0;
    std::size_t first_attribute = 0;
  };
  void add(const Element& element, std::size_t parent);

  const Document& document_;
  TextArena texts_;
  std::vector<Row> rows_;
  std::vector<std::pair<const char*, const char*>> attributes_;
  std::unordered_map<const Element*, std::size_t> index_;
};

}  // namespace nacre::api
