#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace nacre {

/// What is wrong with a text, and where.
struct TextFault {
  std::size_t offset = 0;  ///< In bytes from the start of the text.
  std::string code;
  std::string message;
  std::string expected = {};
  std::string found = {};
};

/// The first character that may not be in a document: bytes that are not UTF-8
/// (RFC 3629), control characters, and references "&...;" to anything but a
/// character or one of XML's five entities (XML 1.0, sections 2.2 and 4.1).
std::optional<TextFault> find_bad_character(std::string_view text);

/// Text before or behind the root element, where XML has none.
std::optional<TextFault> find_text_outside(std::string_view text);

/// Why a text that the XML parser refused is not well-formed: where the tag, comment
/// or attribute begins that is not right. Nothing if all of it looks right.
std::optional<TextFault> find_markup_fault(std::string_view text);

/// The encoding that the XML declaration names; "" without one.
std::string_view declared_encoding(std::string_view text);

}  // namespace nacre
