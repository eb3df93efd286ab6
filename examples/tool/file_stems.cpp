#include "examples/tool/file_stems.h"

#include <fmt/format.h>

namespace nacre::tool {

namespace {

/// File names have at most 255 bytes; extensions, tiles and numbers come behind.
constexpr std::size_t longest = 200;

bool is_plain(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  const bool is_beyond_ascii = static_cast<unsigned char>(c) >= 0x80;
  return is_letter || is_beyond_ascii || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

std::string plain(std::string_view name) {
  std::string stem(name);
  for (char& c : stem) {
    if (c == '/' || c == ':') {
      c = '.';
    } else if (!is_plain(c)) {
      c = '_';
    }
  }
  if (stem.empty() || stem.front() == '.') stem.replace(0, stem.empty() ? 0 : 1, "_");
  std::size_t size = stem.size();
  if (size > longest) {
    size = longest;
    while ((static_cast<unsigned char>(stem[size]) & 0xC0) == 0x80) --size;
  }
  return stem.substr(0, size);
}

}  // namespace

std::string FileStems::stem_of(std::string_view name, const SourceLocation& where,
                               Diagnostics& diagnostics) {
  const std::string wanted = plain(name);
  std::string stem = wanted;
  for (int number = 2; !taken_.insert(stem).second; ++number) {
    stem = fmt::format("{}_{}", wanted, number);
  }
  if (stem != wanted) {
    diagnostics.warning("name-taken", where,
                        fmt::format("the file for '{}' is named '{}'", name, stem),
                        "names that differ as names of files", fmt::format("'{}' twice", wanted));
  }
  return stem;
}

}  // namespace nacre::tool
