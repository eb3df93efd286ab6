#include "jit/document/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "jit/document/text_check.h"

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
    SourceLocation where = at(offset);
    where.path = element_path(element);
    diagnostics.error("duplicate-attribute", where,
                      fmt::format("attribute '{}' is given twice", twice));
  }

  // Elements say all they say in attributes: text is something that slipped.
  void warn_of_text(const Element& element, const pugi::xml_node& node) {
    const std::string_view text = node.value();
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return;
    SourceLocation where = at(node.offset_debug() + static_cast<std::ptrdiff_t>(first));
    where.path = element_path(element);
    const std::string_view line = text.substr(first, 60);
    diagnostics.warning("stray-text", where, "text between tags means nothing", "an attribute",
                        fmt::format("'{}'", line.substr(0, line.find_first_of("\r\n"))));
  }

  // Without recursion: the depth is the document's choice until it is checked.
  Element* convert_tree(const pugi::xml_node& top) {
    Element* root = &convert(top);
    check_attributes(*root, top.offset_debug());
    std::vector<std::pair<pugi::xml_node, Element*>> open{{top.first_child(), root}};
    while (!open.empty()) {
      pugi::xml_node node = open.back().first;
      if (!node) {
        open.pop_back();
        continue;
      }
      open.back().first = node.next_sibling();
      if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
        warn_of_text(*open.back().second, node);
      }
      if (node.type() != pugi::node_element) continue;
      if (open.size() + 1 > static_cast<std::size_t>(limits.xml_depth)) {
        diagnostics.error("too-deep", at(node.offset_debug()), "elements are nested too deeply",
                          fmt::format("at most {} levels", limits.xml_depth));
        return nullptr;
      }
      Element& child = convert(node);
      document.append(*open.back().second, child);
      check_attributes(child, node.offset_debug());
      if (node.first_child()) open.emplace_back(node.first_child(), &child);
    }
    return failed ? nullptr : root;
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
                   const ReadLimits& limits, Diagnostics& diagnostics) {
  Reader reader{document, file, limits, diagnostics, {}};
  const auto refuse = [&](TextFault fault) -> Element* {
    diagnostics.error(std::move(fault.code), reader.at(static_cast<std::ptrdiff_t>(fault.offset)),
                      std::move(fault.message), std::move(fault.expected), std::move(fault.found));
    return nullptr;
  };
  if (auto fault = find_bad_character(text)) return refuse(std::move(*fault));
  if (const std::string_view encoding = declared_encoding(text); !is_utf8(encoding)) {
    diagnostics.warning("declared-encoding", reader.at(0),
                        "the file says that it is of another encoding, and is read as UTF-8",
                        "UTF-8", fmt::format("'{}'", encoding.substr(0, 40)));
  }
  const auto tags = static_cast<std::size_t>(std::count(text.begin(), text.end(), '<'));
  if (tags / 2 > limits.elements) {
    diagnostics.error("too-many-elements", reader.at(0), "the file has too many elements",
                      fmt::format("at most {}", limits.elements));
    return nullptr;
  }
  pugi::xml_document xml;
  const pugi::xml_parse_result result =
      xml.load_buffer_inplace(document.text(file), text.size(), parse_flags, pugi::encoding_utf8);
  bool has_doctype = false;
  for (const pugi::xml_node& node : xml.children()) {
    has_doctype = has_doctype || node.type() == pugi::node_doctype;
  }
  if (!result || has_doctype) return refuse(find_markup_fault(text).value_or(fault_of(result)));
  if (auto fault = find_text_outside(text)) return refuse(std::move(*fault));
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
