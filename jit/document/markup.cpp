// Where tags, comments and attributes of a text that is not XML go wrong. The
// parser says that much only that something does.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "jit/document/text_check.h"

namespace nacre {

namespace {

constexpr std::string_view white = " \t\r\n";
constexpr std::size_t none = std::string_view::npos;

bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool continues_name(char c) {
  return starts_name(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
}

class MarkupScan {
 public:
  explicit MarkupScan(std::string_view text) : text_(text) {}

  std::optional<TextFault> run() {
    while (!fault_ && (at_ = text_.find('<', at_)) != none) step();
    if (!fault_ && !open_.empty()) report_open(text_.size());
    if (!fault_ && !has_element_) fail(0, "there is no element in it", "<materialx>");
    return fault_;
  }

 private:
  struct Tag {
    std::string_view name;
    std::size_t offset;
  };

  void step() {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("<!--")) return skip("<!--", "-->", "a comment is not closed");
    if (rest.starts_with("<![CDATA[")) {
      return skip("<![CDATA[", "]]>", "a CDATA section is not closed");
    }
    if (rest.starts_with("<?")) return skip("<?", "?>", "a processing instruction is not closed");
    if (rest.starts_with("<!")) {
      fault_ = TextFault{at_, "doctype", "document type declarations are not allowed"};
      return;
    }
    if (rest.starts_with("</")) return end_tag();
    start_tag();
  }

  void skip(std::string_view begin, std::string_view end, const char* message) {
    const std::size_t found = text_.find(end, at_ + begin.size());
    if (found == none) return fail(at_, message, fmt::format("'{}'", end));
    at_ = found + end.size();
  }

  void end_tag() {
    const std::size_t start = at_;
    at_ += 2;
    const std::string_view name = take_name();
    at_ = std::min(text_.find_first_not_of(white, at_), text_.size());
    if (name.empty() || at_ == text_.size() || text_[at_] != '>') {
      return fail(start, "an end tag is malformed", "'</NAME>'", shown(start));
    }
    if (open_.empty()) {
      return fail(start, "an end tag has no start tag", "", fmt::format("</{}>", name));
    }
    if (open_.back().name != name) return report_open(start);
    open_.pop_back();
  }

  // The innermost element that is open should have ended by `where`.
  void report_open(std::size_t where) {
    const Tag& tag = open_.back();
    const auto line = 1 + std::count(text_.begin(),
                                     text_.begin() + static_cast<std::ptrdiff_t>(tag.offset), '\n');
    const bool at_end = where == text_.size();
    fail(where, at_end ? "an element is not closed" : "an end tag does not match its start tag",
         fmt::format("</{}>, for <{}> of line {}", clipped(tag.name), clipped(tag.name), line),
         at_end ? "the end of the file" : shown(where));
  }

  void start_tag() {
    const std::size_t start = at_++;
    const std::string_view name = take_name();
    if (name.empty()) {
      return fail(start, "'<' begins no tag", "the name of an element", shown(start));
    }
    has_element_ = true;
    for (;;) {
      const std::size_t before = at_;
      at_ = text_.find_first_not_of(white, at_);
      if (at_ == none) return fail(start, "a start tag is not closed", "'>'", shown(start));
      if (text_.substr(at_).starts_with("/>")) return;
      if (text_[at_] == '>') break;
      const std::size_t attribute = at_;
      if (at_ == before) {
        return fail(attribute, "attributes are not separated", "a space", shown(attribute));
      }
      if (!take_attribute()) return;
    }
    open_.push_back({name, start});
  }

  bool take_attribute() {
    const std::size_t start = at_;
    const std::string_view name = take_name();
    at_ = std::min(text_.find_first_not_of(white, at_), text_.size());
    if (name.empty()) {
      fail(start, "this is not an attribute", "NAME=\"VALUE\", '>' or '/>'", shown(start));
    } else if (at_ == text_.size() || text_[at_] != '=') {
      fail(start, "an attribute has no value", fmt::format("{}=\"VALUE\"", clipped(name)),
           shown(start));
    }
    if (fault_) return false;
    at_ = std::min(text_.find_first_not_of(white, at_ + 1), text_.size());
    if (at_ == text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) {
      fail(start, "the value of an attribute is not in quotes",
           fmt::format("{}=\"VALUE\"", clipped(name)), shown(start));
      return false;
    }
    const std::size_t close = text_.find(text_[at_], at_ + 1);
    if (close == none) {
      fail(start, "the value of an attribute is not closed", fmt::format("{}", text_[at_]),
           shown(start));
      return false;
    }
    at_ = close + 1;
    return true;
  }

  std::string_view take_name() {
    const std::size_t start = at_;
    if (at_ < text_.size() && starts_name(text_[at_])) {
      while (at_ < text_.size() && continues_name(text_[at_])) ++at_;
    }
    return text_.substr(start, at_ - start);
  }

  static std::string_view clipped(std::string_view name) { return name.substr(0, 60); }

  // The beginning of what stands at `offset`, on one line.
  std::string shown(std::size_t offset) const {
    const std::string_view rest = text_.substr(offset, 40);
    return fmt::format("'{}'", rest.substr(0, rest.find_first_of("\r\n")));
  }

  void fail(std::size_t offset, const char* message, std::string expected, std::string found = {}) {
    fault_ = TextFault{offset, "malformed-xml",
                       fmt::format("the file is not well-formed XML: {}", message),
                       std::move(expected), std::move(found)};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool has_element_ = false;
  std::vector<Tag> open_;
  std::optional<TextFault> fault_;
};

// Behind what may stand before the root element.
std::size_t skip_prolog(std::string_view text) {
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (;;) {
    at = text.find_first_not_of(white, at);
    if (at == none) return none;
    const std::string_view rest = text.substr(at);
    std::string_view end;
    if (rest.starts_with("<?")) end = "?>";
    if (rest.starts_with("<!--")) end = "-->";
    if (end.empty()) return at;
    const std::size_t closed = text.find(end, at + 2);
    if (closed == none) return at;
    at = closed + end.size();
  }
}

TextFault outside(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at, 40);
  return {at, "stray-text", "there is text outside the root element", "",
          fmt::format("'{}'", rest.substr(0, rest.find_first_of("<\r\n")))};
}

}  // namespace

std::optional<TextFault> find_text_outside(std::string_view text) {
  const std::size_t root = skip_prolog(text);
  if (root != none && text[root] != '<') return outside(text, root);
  const std::size_t last = text.find_last_of('>');
  if (last == none) return std::nullopt;
  const std::size_t behind = text.find_first_not_of(white, last + 1);
  return behind == none ? std::nullopt : std::optional(outside(text, behind));
}

std::optional<TextFault> find_markup_fault(std::string_view text) { return MarkupScan(text).run(); }

}  // namespace nacre
