// Which characters a document may hold, whatever they mean.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include "jit/document/text_check.h"

namespace nacre {

namespace {

unsigned char byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

bool is_control(unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r'; }

/// What there is in a text; most have none of these and need no closer look.
struct Contents {
  bool beyond_ascii = false;
  bool control = false;
  bool references = false;
};

// Without branches, so that it becomes vector code.
Contents contents_of(std::string_view text) {
  unsigned char high = 0;
  unsigned char control = 0;
  unsigned char references = 0;
  for (char letter : text) {
    const auto c = static_cast<unsigned char>(letter);
    high |= c;
    control |= static_cast<unsigned char>((c < 0x20) & (c != '\t') & (c != '\n') & (c != '\r'));
    references |= static_cast<unsigned char>(c == '&');
  }
  return {high >= 0x80, control != 0, references != 0};
}

/// Bytes of the UTF-8 sequence at `at`, 0 if that is none: cut short, overlong, a
/// surrogate, or beyond U+10FFFF (RFC 3629, section 4).
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const unsigned char first = byte_at(text, at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + length > text.size()) return 0;
  const unsigned char second = byte_at(text, at + 1);
  const unsigned char least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned char most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (second < least || second > most) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if ((byte_at(text, at + i) & 0xC0) != 0x80) return 0;
  }
  return length;
}

std::optional<TextFault> find_bad_sequence(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = sequence_length(text, at);
    if (length == 0) {
      return TextFault{at, "bad-encoding", "the file is not UTF-8 text", "UTF-8",
                       fmt::format("byte 0x{:02X}", byte_at(text, at))};
    }
    at += length;
  }
  return std::nullopt;
}

std::optional<TextFault> find_control(std::string_view text) {
  const auto control = [](char c) { return is_control(static_cast<unsigned char>(c)); };
  const auto found = std::find_if(text.begin(), text.end(), control);
  if (found == text.end()) return std::nullopt;
  return TextFault{static_cast<std::size_t>(found - text.begin()), "bad-character",
                   "a control character is not allowed in a document", "",
                   fmt::format("byte 0x{:02X}", static_cast<unsigned char>(*found))};
}

bool is_character(std::uint32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code < 0xD800 || (code > 0xDFFF && code < 0xFFFE) || (code > 0xFFFF && code <= 0x10FFFF);
}

/// A reference's text, from behind '&' up to ';'.
std::optional<TextFault> check_reference(std::string_view inside, std::size_t offset) {
  constexpr std::array<std::string_view, 5> known{"amp", "lt", "gt", "quot", "apos"};
  if (std::find(known.begin(), known.end(), inside) != known.end()) return std::nullopt;
  if (!inside.starts_with('#')) {
    return TextFault{offset, "unknown-entity", "'&' begins no entity that documents know",
                     "&amp;, &lt;, &gt;, &quot; or &apos;", fmt::format("'&{}'", inside)};
  }
  const bool hexadecimal = inside.starts_with("#x");
  const std::string_view digits = inside.substr(hexadecimal ? 2 : 1);
  std::uint32_t code = 0;
  const char* end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, code, hexadecimal ? 16 : 10);
  if (error == std::errc{} && rest == end && is_character(code)) return std::nullopt;
  return TextFault{offset, "bad-character", "the reference is to no character",
                   "the number of a character that XML allows", fmt::format("'&{};'", inside)};
}

// Comments and CDATA sections may hold any '&'.
std::optional<TextFault> find_bad_reference(std::string_view text) {
  constexpr std::size_t longest = 32;
  std::size_t at = 0;
  while ((at = text.find_first_of("&<", at)) != std::string_view::npos) {
    const std::string_view rest = text.substr(at);
    std::string_view end;
    if (rest.starts_with("<!--")) end = "-->";
    if (rest.starts_with("<![CDATA[")) end = "]]>";
    if (!end.empty()) {
      at = text.find(end, at + 4);
      if (at == std::string_view::npos) return std::nullopt;  // the parser will say so
      continue;
    }
    // The entities that it declares are not what is wrong.
    if (rest.starts_with("<!")) {
      return TextFault{at, "doctype", "document type declarations are not allowed"};
    }
    if (text[at] == '&') {
      const std::string_view inside = rest.substr(1, longest);
      const std::size_t stop = std::min(inside.find_first_of(";\"'<> \t\r\n"), inside.size());
      const bool closed = stop < inside.size() && inside[stop] == ';';
      auto fault = check_reference(inside.substr(0, stop), at);
      if (!fault && !closed) {
        fault = TextFault{at, "unknown-entity", "the reference is not closed", "';'",
                          fmt::format("'&{}'", inside.substr(0, stop))};
      }
      if (fault) return fault;
    }
    ++at;
  }
  return std::nullopt;
}

}  // namespace

std::optional<TextFault> find_bad_character(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return TextFault{0, "bad-encoding", "the file is not UTF-8 text", "UTF-8",
                     "the byte order mark of UTF-16 or UTF-32"};
  }
  const Contents contents = contents_of(text);
  if (contents.control) {
    const std::size_t null = text.find('\0');
    if (null != std::string_view::npos) {
      return TextFault{null, "bad-encoding", "the file is not UTF-8 text", "UTF-8",
                       "a null byte, as UTF-16 and binary files have them"};
    }
  }
  if (contents.beyond_ascii) {
    if (auto fault = find_bad_sequence(text)) return fault;
  }
  if (contents.control) return find_control(text);
  return contents.references ? find_bad_reference(text) : std::nullopt;
}

std::string_view declared_encoding(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (!text.starts_with("<?xml")) return {};
  const std::string_view declaration = text.substr(0, text.find("?>"));
  const std::size_t at = declaration.find("encoding");
  if (at == std::string_view::npos) return {};
  const std::size_t open = declaration.find_first_of("\"'", at);
  if (open == std::string_view::npos) return {};
  const std::size_t close = declaration.find(declaration[open], open + 1);
  if (close == std::string_view::npos) return {};
  return declaration.substr(open + 1, close - open - 1);
}

}  // namespace nacre
