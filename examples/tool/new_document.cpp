#include "examples/tool/new_document.h"

#include <fmt/format.h>

#include "jit/document/write.h"

namespace nacre::tool {

NewDocument::NewDocument()
    : root_(&document_.create("materialx",
                              document_.add_file("baked", std::make_unique<char[]>(1), 0), 0)) {
  document_.set_root(*root_);
  set(*root_, "version", "1.39");
  set(*root_, "colorspace", "lin_rec709");
}

Element& NewDocument::make(std::string_view category, std::string_view name,
                           std::string_view type) {
  Element& element = document_.create(document_.intern(category), 0, 0);
  set(element, "name", name);
  if (!type.empty()) set(element, "type", type);
  return element;
}

Element& NewDocument::copy_of(const Element& element) {
  Element& copy = document_.create(document_.intern(element.category()), 0, 0);
  for (const Attribute& attribute : element.attributes()) {
    set(copy, attribute.name, attribute.name == "name" ? element.name() : attribute.value);
  }
  for (const Element& child : element.children()) append(copy, copy_of(child));
  return copy;
}

Element& NewDocument::add_input(Element& node, std::string_view name, std::string_view type) {
  Element& input = make("input", name);
  set(input, "type", type);
  append(node, input);
  return input;
}

void NewDocument::set(Element& element, std::string_view name, std::string_view value) {
  const std::string_view kept = document_.intern(value);
  document_.set_attribute(element, document_.intern(name), kept);
  if (name == "name") Document::set_name(element, kept);
}

std::string NewDocument::free_name(const std::string& wanted) {
  const int count = names_[wanted]++;
  return count == 0 ? wanted : free_name(fmt::format("{}_{}", wanted, count + 1));
}

std::string NewDocument::text() const { return write_document(document_); }

}  // namespace nacre::tool
