#include "jit/document/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

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
    check_attributes(element, offset);
    return element;
  }

  void check_attributes(const Element& element, std::uint32_t offset) {
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
    where.path = element.name();
    diagnostics.error("duplicate-attribute", where,
                      fmt::format("attribute '{}' is given twice", twice));
  }

  /// One element whose children are being read.
  struct Open {
    pugi::xml_node next;
    Element* element;
    std::vector<Note> notes;  ///< Since the last child.
  };

  // Without recursion: the depth is the document's choice until it is checked.
  Element* convert_tree(const pugi::xml_node& top) {
    Element* root = &convert(top);
    std::vector<Open> open;
    open.push_back({top.first_child(), root, {}});
    while (!open.empty()) {
      Open& at = open.back();
      const pugi::xml_node node = at.next;
      if (!node) {
        document.set_notes_at_end(*at.element, std::move(at.notes));
        open.pop_back();
        continue;
      }
      at.next = node.next_sibling();
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
        notes.push_back({Note::Kind::instruction, document.keep(instruction_text(node))});
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

std::string describe(pugi::xml_parse_status status) {
  switch (status) {
    case pugi::status_no_document_element: return "there is no element in it";
    case pugi::status_end_element_mismatch: return "an end tag does not match its start tag";
    case pugi::status_bad_doctype: return "the document type declaration is malformed";
    case pugi::status_bad_attribute: return "an attribute is malformed";
    case pugi::status_bad_start_element: return "a start tag is malformed";
    case pugi::status_bad_end_element: return "an end tag is malformed";
    case pugi::status_bad_comment: return "a comment is not closed";
    case pugi::status_bad_cdata: return "a CDATA section is not closed";
    case pugi::status_bad_pi: return "a processing instruction is malformed";
    case pugi::status_out_of_memory: return "there is not enough memory for it";
    default: return "a tag is not recognised";
  }
}

bool check_encoding(std::string_view text) {
  return !text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF") &&
         text.find('\0') == std::string_view::npos;
}

}  // namespace

Element* parse_xml(Document& document, std::uint16_t file, std::size_t size,
                   const ReadOptions& options, Diagnostics& diagnostics) {
  Reader reader{document, file, options, diagnostics, {}};
  char* text = document.text(file);
  if (!check_encoding({text, size})) {
    diagnostics.error("bad-encoding", reader.at_offset(0), "the file is not UTF-8 text", "UTF-8");
    return nullptr;
  }
  const auto tags = static_cast<std::size_t>(std::count(text, text + size, '<'));
  if (tags / 2 > options.limits.elements) {
    diagnostics.error("too-many-elements", reader.at_offset(0), "the file has too many elements",
                      fmt::format("at most {}", options.limits.elements));
    return nullptr;
  }
  pugi::xml_document xml;
  const pugi::xml_parse_result result = xml.load_buffer_inplace(
      text, size, options.keep_comments ? parse_notes_flags : parse_flags, pugi::encoding_utf8);
  for (const pugi::xml_node& node : xml.children()) {
    if (node.type() != pugi::node_doctype) continue;
    diagnostics.error("doctype", reader.at_offset(node.offset_debug()),
                      "document type declarations are not allowed");
    return nullptr;
  }
  if (!result) {
    diagnostics.error("malformed-xml", reader.at_offset(result.offset),
                      fmt::format("the file is not well-formed XML: {}", describe(result.status)));
    return nullptr;
  }
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
