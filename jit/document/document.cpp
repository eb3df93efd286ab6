#include "jit/document/document.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

namespace nacre {

namespace {

// Scopes with fewer children are searched one by one.
constexpr std::size_t small_scope = 16;

std::vector<std::uint32_t> find_line_starts(const char* text, std::size_t size) {
  std::vector<std::uint32_t> starts{0};
  const char* at = text;
  const char* end = text + size;
  while (at < end) {
    const void* hit = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
    if (hit == nullptr) break;
    at = static_cast<const char*>(hit) + 1;
    starts.push_back(static_cast<std::uint32_t>(at - text));
  }
  return starts;
}

}  // namespace

std::string_view Element::attribute(std::string_view name) const {
  for (const Attribute& candidate : attributes()) {
    if (candidate.name == name) return candidate.value;
  }
  return {};
}

bool Element::has_attribute(std::string_view name) const {
  for (const Attribute& candidate : attributes()) {
    if (candidate.name == name) return true;
  }
  return false;
}

std::string_view Element::inherited_attribute(std::string_view name) const {
  for (const Element* element = this; element != nullptr; element = element->parent_) {
    if (element->has_attribute(name)) return element->attribute(name);
  }
  return {};
}

const Element* Element::child(std::string_view name) const {
  if (name.empty()) return nullptr;
  if (indexed_) {
    const Document::NameTable& table = document_->tables_.at(this);
    const auto found = table.find(name);
    return found == table.end() ? nullptr : found->second;
  }
  for (const Element& candidate : children()) {
    if (candidate.name_ == name) return &candidate;
  }
  return nullptr;
}

SourceLocation location(const Element& element) {
  const Document& document = element.document();
  return {document.file_of(element), document.line_of(element), document.column_of(element),
          element_path(element)};
}

std::string element_path(const Element& element) {
  std::vector<std::string_view> parts;
  for (const Element* at = &element; at->parent() != nullptr; at = at->parent()) {
    parts.push_back(at->name().empty() ? at->category() : at->name());
  }
  std::string path;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    if (!path.empty()) path += '/';
    path += *part;
  }
  return path;
}

std::string qualified_name(const Element& element, std::string_view name) {
  const std::string_view space = element.inherited_attribute("namespace");
  if (space.empty() || name.empty()) return std::string(name);
  if (name.size() > space.size() && name.starts_with(space) && name[space.size()] == ':') {
    return std::string(name);
  }
  std::string result(space);
  result += ':';
  result += name;
  return result;
}

Document::Document() = default;
Document::~Document() = default;

const std::string& Document::file_of(const Element& element) const {
  return file_names_[element.file_];
}

int Document::line_of(const Element& element) const {
  const std::vector<std::uint32_t>& starts = line_starts_[element.file_];
  const auto after = std::upper_bound(starts.begin(), starts.end(), element.offset_);
  return static_cast<int>(after - starts.begin());
}

int Document::column_of(const Element& element) const {
  const std::vector<std::uint32_t>& starts = line_starts_[element.file_];
  return static_cast<int>(element.offset_ - starts[line_of(element) - 1]) + 1;
}

std::string_view Document::intern(std::string_view text) {
  char* copy = static_cast<char*>(arena_.allocate(text.size() + 1, 1));
  if (!text.empty()) std::memcpy(copy, text.data(), text.size());
  return {copy, text.size()};
}

std::uint16_t Document::add_file(std::string name, std::unique_ptr<char[]> text, std::size_t size) {
  assert(file_names_.size() < std::numeric_limits<std::uint16_t>::max());
  assert(size <= std::numeric_limits<std::uint32_t>::max());
  line_starts_.push_back(find_line_starts(text.get(), size));
  file_names_.push_back(std::move(name));
  texts_.push_back(std::move(text));
  return static_cast<std::uint16_t>(file_names_.size() - 1);
}

Element& Document::create(std::string_view category, std::uint16_t file, std::uint32_t offset) {
  static_assert(std::is_trivially_destructible_v<Element>);
  auto* element = new (arena_.allocate(sizeof(Element), alignof(Element))) Element;
  element->category_ = category;
  element->document_ = this;
  element->file_ = file;
  element->offset_ = offset;
  return *element;
}

Element& Document::create_at(std::string_view category, const Element& place) {
  return create(category, place.file_, place.offset_);
}

void Document::append(Element& parent, Element& child) {
  child.parent_ = &parent;
  child.next_ = nullptr;
  if (parent.last_child_ != nullptr) {
    parent.last_child_->next_ = &child;
  } else {
    parent.first_child_ = &child;
  }
  parent.last_child_ = &child;
  ++parent.child_count_;
}

Element* Document::take_children(Element& parent) {
  Element* first = parent.first_child_;
  parent.first_child_ = nullptr;
  parent.last_child_ = nullptr;
  parent.child_count_ = 0;
  return first;
}

void Document::set_attributes(Element& element, std::span<const Attribute> attributes) {
  void* place = arena_.allocate(attributes.size() * sizeof(Attribute), alignof(Attribute));
  auto* copy = static_cast<Attribute*>(place);
  std::uninitialized_copy(attributes.begin(), attributes.end(), copy);
  element.attributes_ = copy;
  element.attribute_count_ = static_cast<std::uint32_t>(attributes.size());
}

void Document::set_attribute(Element& element, std::string_view name, std::string_view value) {
  std::vector<Attribute> attributes(element.attributes().begin(), element.attributes().end());
  const auto same = [&](const Attribute& attribute) { return attribute.name == name; };
  const auto found = std::find_if(attributes.begin(), attributes.end(), same);
  if (found == attributes.end()) {
    attributes.push_back({name, value});
  } else {
    found->value = value;
  }
  set_attributes(element, attributes);
}

void Document::remove_attribute(Element& element, std::string_view name) {
  if (!element.has_attribute(name)) return;
  std::vector<Attribute> attributes(element.attributes().begin(), element.attributes().end());
  std::erase_if(attributes, [&](const Attribute& attribute) { return attribute.name == name; });
  set_attributes(element, attributes);
}

std::span<const Note> Document::notes_before(const Element& element) const {
  const auto found = before_.find(&element);
  return found == before_.end() ? std::span<const Note>() : found->second;
}

std::span<const Note> Document::notes_at_end(const Element& parent) const {
  const auto found = at_end_.find(&parent);
  return found == at_end_.end() ? std::span<const Note>() : found->second;
}

void Document::set_notes_before(const Element& element, std::vector<Note> notes) {
  if (!notes.empty()) before_[&element] = std::move(notes);
}

void Document::set_notes_at_end(const Element& parent, std::vector<Note> notes) {
  if (!notes.empty()) at_end_[&parent] = std::move(notes);
}

void Document::move_notes(const Element& from, const Element* to, const Element& parent) {
  const auto found = before_.find(&from);
  if (found == before_.end()) return;
  std::vector<Note> notes = std::move(found->second);
  before_.erase(found);
  std::vector<Note>& place = to != nullptr ? before_[to] : at_end_[&parent];
  notes.insert(notes.end(), place.begin(), place.end());
  place = std::move(notes);
}

void Document::build_index() {
  tables_.clear();
  std::vector<Element*> pending{root_};
  while (!pending.empty()) {
    Element* element = pending.back();
    pending.pop_back();
    element->indexed_ = element->child_count_ > small_scope;
    NameTable* table = nullptr;
    if (element->indexed_) {
      table = &tables_[element];
      table->reserve(element->child_count_);
    }
    for (Element* child = element->first_child_; child != nullptr; child = child->next_) {
      if (table != nullptr && !child->name_.empty()) table->emplace(child->name_, child);
      if (child->first_child_ != nullptr) pending.push_back(child);
    }
  }
}

}  // namespace nacre
