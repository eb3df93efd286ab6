#include "tests/fuzz/tree.h"

#include <algorithm>
#include <cctype>

namespace nacre::fuzz {

namespace {

constexpr std::size_t most_depth = 100;

/// Not the project's reader: what is under test should not choose what it is tested with.
class TreeReader {
 public:
  explicit TreeReader(std::string_view text) : text_(text) {}

  std::optional<Tree> read() {
    std::vector<Tree> open;  // the chain of elements that are not closed yet
    while (find('<')) {
      if (skip_other()) continue;
      if (take("</")) {
        if (open.empty() || !find('>')) return std::nullopt;
        Tree closed = std::move(open.back());
        open.pop_back();
        if (open.empty()) return closed;
        open.back().children.push_back(std::move(closed));
        continue;
      }
      ++at_;
      Tree element;
      bool empty = false;
      if (!read_tag(element, empty) || open.size() == most_depth) return std::nullopt;
      if (!empty) {
        open.push_back(std::move(element));
      } else if (open.empty()) {
        return element;
      } else {
        open.back().children.push_back(std::move(element));
      }
    }
    return std::nullopt;
  }

 private:
  static bool is_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == ':' || c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
  }
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

  bool find(char c) {
    at_ = text_.find(c, at_);
    return at_ != std::string_view::npos;
  }
  bool take(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }
  bool skip_past(std::string_view end) {
    at_ = std::min(text_.find(end, at_), text_.size());
    return true;
  }
  // Comments, instructions, sections of characters, the type of the document.
  bool skip_other() {
    if (take("<!--")) return skip_past("-->");
    if (take("<![CDATA[")) return skip_past("]]>");
    if (take("<?")) return skip_past("?>");
    return take("<!") && skip_past(">");
  }
  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }
  std::string read_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name(text_[at_])) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  bool read_tag(Tree& element, bool& empty) {
    element.category = read_name();
    while (!element.category.empty()) {
      skip_spaces();
      if (take(">")) return true;
      empty = take("/>");
      if (empty) return true;
      std::string name = read_name();
      skip_spaces();
      if (name.empty() || !take("=")) return false;
      skip_spaces();
      std::string value;
      if (!read_value(value)) return false;
      element.attributes.emplace_back(std::move(name), std::move(value));
    }
    return false;
  }

  bool read_value(std::string& value) {
    if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return false;
    const std::size_t end = text_.find(text_[at_], at_ + 1);
    if (end == std::string_view::npos) return false;
    value = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return value.find('<') == std::string::npos;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Values that were cut and joined may have half an entity, or a bare sign.
bool begins_entity(std::string_view text) {
  const std::size_t end = text.substr(0, 12).find(';');
  return end != std::string_view::npos && end > 1 &&
         std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(end), [](char c) {
           return c == '#' || std::isalnum(static_cast<unsigned char>(c)) != 0;
         });
}

void write_value(std::string_view value, std::string& text) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    switch (value[i]) {
      case '"': text += "&quot;"; break;
      case '<': text += "&lt;"; break;
      case '&': text += begins_entity(value.substr(i)) ? "&" : "&amp;"; break;
      default: text += value[i];
    }
  }
}

void write(const Tree& tree, std::size_t depth, std::string& text) {
  text.append(2 * depth, ' ').append("<").append(tree.category);
  for (const auto& [name, value] : tree.attributes) {
    text.append(" ").append(name).append("=\"");
    write_value(value, text);
    text += '"';
  }
  if (tree.children.empty()) {
    text += "/>\n";
    return;
  }
  text += ">\n";
  for (const Tree& child : tree.children) write(child, depth + 1, text);
  text.append(2 * depth, ' ').append("</").append(tree.category).append(">\n");
}

template <class Element>
std::vector<Element*> collect(Element& tree) {
  std::vector<Element*> list{&tree};
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (auto& child : list[i]->children) list.push_back(&child);
  }
  return list;
}

}  // namespace

const std::string* Tree::find(std::string_view name) const {
  for (const auto& [key, value] : attributes) {
    if (key == name) return &value;
  }
  return nullptr;
}

void Tree::set(std::string_view name, std::string_view value) {
  for (auto& [key, old] : attributes) {
    if (key != name) continue;
    old = value;
    return;
  }
  attributes.emplace_back(name, value);
}

std::optional<Tree> read_tree(std::string_view text) { return TreeReader(text).read(); }

std::string write_tree(const Tree& tree) {
  std::string text;
  write(tree, 0, text);
  return text;
}

std::vector<Tree*> all_elements(Tree& tree) { return collect(tree); }

std::vector<const Tree*> all_elements(const Tree& tree) { return collect(tree); }

}  // namespace nacre::fuzz
