#include "jit/api/element_list.h"

#include "jit/graph/find.h"

namespace nacre::api {

ElementList::ElementList(const Document& document) : document_(document) {
  // Documents may be deep: a way up and down without recursion.
  const Element* at = &document.root();
  std::size_t parent = SIZE_MAX;
  while (true) {
    add(*at, parent);
    const ElementRange children = at->children();
    if (children.begin() != children.end()) {
      parent = rows_.size() - 1;
      at = &*children.begin();
      continue;
    }
    rows_.back().end = rows_.size();
    while (at != &document.root() && at->next() == nullptr) {
      at = at->parent();
      rows_[parent].end = rows_.size();
      parent = rows_[parent].parent;
    }
    if (at == &document.root()) return;
    at = at->next();
  }
}

void ElementList::add(const Element& element, std::size_t parent) {
  Row row;
  row.element = &element;
  row.category = texts_.keep(element.category());
  row.name = texts_.keep(element.name());
  row.parent = parent;
  row.first_attribute = attributes_.size();
  for (const Attribute& attribute : element.attributes()) {
    attributes_.emplace_back(texts_.keep(attribute.name), texts_.keep(attribute.value));
  }
  index_.emplace(&element, rows_.size());
  rows_.push_back(row);
}

nacre_element ElementList::element(std::size_t index) const {
  const Row& row = rows_[index];
  nacre_element made{};
  made.category = row.category;
  made.name = row.name;
  made.parent = row.parent;
  made.end = row.end;
  made.attribute_count = row.element->attributes().size();
  made.file = document_.file_of(*row.element).c_str();
  made.line = document_.line_of(*row.element);
  made.column = document_.column_of(*row.element);
  return made;
}

std::pair<const char*, const char*> ElementList::attribute(std::size_t element,
                                                           std::size_t index) const {
  const Row& row = rows_[element];
  if (index >= row.element->attributes().size()) return {nullptr, nullptr};
  return attributes_[row.first_attribute + index];
}

const char* ElementList::find_attribute(std::size_t element, std::string_view name) const {
  const Row& row = rows_[element];
  for (std::size_t i = 0; i < row.element->attributes().size(); ++i) {
    if (attributes_[row.first_attribute + i].first == name) {
      return attributes_[row.first_attribute + i].second;
    }
  }
  return nullptr;
}

std::size_t ElementList::find(std::string_view path) const {
  const Element* found = find_element(document_, path);
  return found != nullptr ? index_.at(found) : SIZE_MAX;
}

}  // namespace nacre::api
