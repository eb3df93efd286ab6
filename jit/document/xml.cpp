#include "jit/document/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace nacre {

namespace {

constexpr unsigned parse_flags = pugi::parse_default | pugi::parse_doctype;

struct Reader {
  Document& document;
  std::uint16_t file;
  const ReadLimits& limits;
  Diagnostics& diagnostics;
  std::vector<Attribute> attributes;
  bool failed = false;

  SourceLocation at(std::ptrdiff_t offset) {
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
    SourceLocation where = at(offset);
    where.path = element.name();
    diagnostics.error("duplicate-attribute", where,
                      fmt::format("attribute '{}' is given twice", twice));
  }

  // Without recursion: the depth is the document's choice until it is checked.
  Element* convert_tree(const pugi::xml_node& top) {
    Element* root = &convert(top);
    std::vector<std::pair<pugi::xml_node, Element*>> open{{top.first_child(), root}};
    while (!open.empty()) {
      pugi::xml_node node = open.back().first;
      if (!node) {
        open.pop_back();
        continue;
      }
      open.back().first = node.next_sibling();
      if (node.type() != pugi::node_element) continue;
      if (open.size() + 1 > static_cast<std::size_t>(limits.xml_depth)) {
        diagnostics.error("too-deep", at(node.offset_debug()), "elements are nested too deeply",
                          fmt::format("at most {} levels", limits.xml_depth));
        return nullptr;
      }
      Element& child = convert(node);
      document.append(*open.back().second, child);
      if (node.first_child()) open.emplace_back(node.first_child(), &child);
    }
    return failed ? nullptr : root;
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
                   const ReadLimits& limits, Diagnostics& diagnostics) {
  Reader reader{document, file, limits, diagnostics, {}};
  char* text = document.text(file);
  if (!check_encoding({text, size})) {
    diagnostics.error("bad-encoding", reader.at(0), "the file is not UTF-8 text", "UTF-8");
    return nullptr;
  }
  const auto tags = static_cast<std::size_t>(std::count(text, text + size, '<'));
  if (tags / 2 > limits.elements) {
    diagnostics.error("too-many-elements", reader.at(0), "the file has too many elements",
                      fmt::format("at most {}", limits.elements));
    return nullptr;
  }
  pugi::xml_document xml;
  const pugi::xml_parse_result result =
      xml.load_buffer_inplace(text, size, parse_flags, pugi::encoding_utf8);
  for (const pugi::xml_node& node : xml.children()) {
    if (node.type() != pugi::node_doctype) continue;
    diagnostics.error("doctype", reader.at(node.offset_debug()),
                      "document type declarations are not allowed");
    return nullptr;
  }
  if (!result) {
    diagnostics.error("malformed-xml", reader.at(result.offset),
                      fmt::format("the file is not well-formed XML: {}", describe(result.status)));
    return nullptr;
  }
  const pugi::xml_node top = xml.document_element();
  for (pugi::xml_node node = top.next_sibling(); node; node = node.next_sibling()) {
    if (node.type() != pugi::node_element) continue;
    diagnostics.error("malformed-xml", reader.at(node.offset_debug()),
                      "the file is not well-formed XML: it has a second root element");
    return nullptr;
  }
  return reader.convert_tree(top);
}

}  // namespace nacre
