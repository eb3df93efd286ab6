#include "jit/document/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "jit/document/text_check.h"
#include "runtime/report_stop.h"

namespace nacre {

namespace {

constexpr unsigned parse_flags = pugi::parse_default | pugi::parse_doctype;
constexpr unsigned parse_notes_flags = parse_flags | pugi::parse_comments | pugi::parse_pi |
                                       pugi::parse_declaration | pugi::parse_ws_pcdata;

struct Reader {
  Document& document;
  std::uint16_t file;
  const ReadOptions& options;
  Diagnostics& diagnostics;
  std::vector<Attribute> attributes;
  bool failed = false;

  SourceLocation at_offset(std::ptrdiff_t offset) {
    const auto place = static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(offset, 0));
    const Element& probe = document.create("", file, place);
    return {document.file_of(probe), document.line_of(probe), document.column_of(probe), ""};
  }

  Element& convert(const pugi::xml_node& node) {
    const auto offset = static_cast<std::uint32_t>(node.offset_debug());
    Element& element = document.create(node.name(), file, offset);
    attributes.clear();
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const Attribute entry{attribute.name(), attribute.value()};
      if (entry.name == "name") Document::set_name(element, entry.value);
      attributes.push_back(entry);
    }
    if (!attributes.empty()) document.set_attributes(element, attributes);
    return element;
  }

  // After converting the element, whose attributes still stand in the list, and
  // putting it in its place.
  void check_attributes(const Element& element, std::ptrdiff_t offset) {
    std::string_view twice;
    if (attributes.size() <= 16) {
      for (std::size_t i = 1; i < attributes.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          if (attributes[i].name == attributes[j].name) twice = attributes[i].name;
        }
      }
    } else {
      std::unordered_set<std::string_view> seen;
      for (const Attribute& attribute : attributes) {
        if (!seen.insert(attribute.name).second) twice = attribute.name;
      }
    }
    if (twice.data() == nullptr) return;
    failed = true;
    SourceLocation where = at_offset(offset);
    where.path = element_path(element);
    diagnostics.error("duplicate-attribute", where,
                      fmt::format("attribute '{}' is given twice", twice));
  }

  /// One element whose children are being read.
  struct Open {
    pugi::xml_node next;
    Element* element;
    std::vector<Note> notes;  ///< Since the last child.
  };

  // Elements say all they say in attributes: text is something that slipped.
  void warn_of_text(const Element& element, const pugi::xml_node& node) {
    const std::string_view text = node.value();
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return;
    SourceLocation where = at_offset(node.offset_debug() + static_cast<std::ptrdiff_t>(first));
    where.path = element_path(element);
    const std::string_view line = text.substr(first, 60);
    diagnostics.warning("stray-text", where, "text between tags means nothing", "an attribute",
                        fmt::format("'{}'", line.substr(0, line.find_first_of("\r\n"))));
  }

  // Without recursion: the depth is the document's choice until it is checked.
  Element* convert_tree(const pugi::xml_node& top) {
    Element* root = &convert(top);
    std::vector<Open> open;
    std::size_t seen = 0;
    open.push_back({top.first_child(), root, {}});
    check_attributes(*root, top.offset_debug());
    while (!open.empty()) {
      Open& at = open.back();
      const pugi::xml_node node = at.next;
      if (!node) {
        document.set_notes_at_end(*at.element, std::move(at.notes));
        open.pop_back();
        continue;
      }
      at.next = node.next_sibling();
      if ((++seen & 0xFFF) == 0 && options.stop.is_due()) {
        report_if_due(options.stop, "reading", at_offset(node.offset_debug()), diagnostics);
        return nullptr;
      }
      if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
        warn_of_text(*at.element, node);
      }
      if (node.type() != pugi::node_element) {
        if (options.keep_comments) add_note(node, at.notes);
        continue;
      }
      if (open.size() + 1 > static_cast<std::size_t>(options.limits.xml_depth)) {
        diagnostics.error("too-deep", at_offset(node.offset_debug()),
                          "elements are nested too deeply",
                          fmt::format("at most {} levels", options.limits.xml_depth));
        return nullptr;
      }
      Element& child = convert(node);
      document.append(*at.element, child);
      check_attributes(child, node.offset_debug());
      document.set_notes_before(child, std::exchange(at.notes, {}));
      if (node.first_child()) open.push_back({node.first_child(), &child, {}});
    }
    return failed ? nullptr : root;
  }

  void add_note(const pugi::xml_node& node, std::vector<Note>& notes) {
    const std::string_view text = node.value();
    switch (node.type()) {
      case pugi::node_comment: notes.push_back({Note::Kind::comment, text}); break;
      case pugi::node_cdata: notes.push_back({Note::Kind::cdata, text}); break;
      case pugi::node_pi:
      case pugi::node_declaration:
        notes.push_back({Note::Kind::instruction, document.intern(instruction_text(node))});
        break;
      case pugi::node_pcdata:
        if (text.find_first_not_of(" \t\r\n") != std::string_view::npos) {
          notes.push_back({Note::Kind::text, text});
        } else if (std::count(text.begin(), text.end(), '\n') > 1) {
          notes.push_back({Note::Kind::blank_line});
        }
        break;
      default: break;
    }
  }

  static std::string instruction_text(const pugi::xml_node& node) {
    std::string text = node.name();
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      text += fmt::format(" {}=\"{}\"", attribute.name(), attribute.value());
    }
    if (*node.value() != '\0') text += std::string(" ") + node.value();
    return text;
  }

  /// What stands before and behind the root element.
  void keep_outside(const pugi::xml_document& xml, const pugi::xml_node& top, Element& root) {
    std::vector<Note> before, behind;
    bool seen = false;
    for (const pugi::xml_node& node : xml.children()) {
      seen = seen || node == top;
      if (node != top) add_note(node, seen ? behind : before);
    }
    document.set_notes_before(root, std::move(before));
    // Of the main file, which is read first; what it includes comes later.
    if (file == 0) document.set_notes_behind(std::move(behind));
  }
};

/// How the parser itself puts it, where we find no better words.
TextFault fault_of(const pugi::xml_parse_result& result) {
  const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0));
  return {offset, "malformed-xml",
          fmt::format("the file is not well-formed XML: {}", result.description())};
}

bool is_utf8(std::string_view encoding) {
  std::string lower(encoding);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower.empty() || lower == "utf-8" || lower == "utf8" || lower == "us-ascii" ||
         lower == "ascii";
}

}  // namespace

Element* parse_xml(Document& document, std::uint16_t file, std::string_view text,
                   const ReadOptions& options, Diagnostics& diagnostics) {
  Reader reader{document, file, options, diagnostics, {}};
  const auto refuse = [&](TextFault fault) -> Element* {
    diagnostics.error(std::move(fault.code),
                      reader.at_offset(static_cast<std::ptrdiff_t>(fault.offset)),
                      std::move(fault.message), std::move(fault.expected), std::move(fault.found));
    return nullptr;
  };
  if (auto fault = find_bad_character(text)) return refuse(std::move(*fault));
  if (const std::string_view encoding = declared_encoding(text); !is_utf8(encoding)) {
    diagnostics.warning("declared-encoding", reader.at_offset(0),
                        "the file says that it is of another encoding, and is read as UTF-8",
                        "UTF-8", fmt::format("'{}'", encoding.substr(0, 40)));
  }
  const auto tags = static_cast<std::size_t>(std::count(text.begin(), text.end(), '<'));
  if (tags / 2 > options.limits.elements) {
    diagnostics.error("too-many-elements", reader.at_offset(0), "the file has too many elements",
                      fmt::format("at most {}", options.limits.elements));
    return nullptr;
  }
  pugi::xml_document xml;
  const pugi::xml_parse_result result = xml.load_buffer_inplace(
      document.text(file), text.size(), options.keep_comments ? parse_notes_flags : parse_flags,
      pugi::encoding_utf8);
  bool has_doctype = false;
  for (const pugi::xml_node& node : xml.children()) {
    has_doctype = has_doctype || node.type() == pugi::node_doctype;
  }
  if (!result || has_doctype) return refuse(find_markup_fault(text).value_or(fault_of(result)));
  if (auto fault = find_text_outside(text)) return refuse(std::move(*fault));
  const pugi::xml_node top = xml.document_element();
  for (pugi::xml_node node = top.next_sibling(); node; node = node.next_sibling()) {
    if (node.type() != pugi::node_element) continue;
    diagnostics.error("malformed-xml", reader.at_offset(node.offset_debug()),
                      "the file is not well-formed XML: it has a second root element");
    return nullptr;
  }
  Element* root = reader.convert_tree(top);
  if (root != nullptr && options.keep_comments) reader.keep_outside(xml, top, *root);
  return root;
}

}  // namespace nacre
