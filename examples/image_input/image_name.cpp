#include "examples/image_input/image_name.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "examples/image_input/wrong.h"

namespace graph_image {

namespace {

namespace fs = std::filesystem;

/// A longer text file is another one.
constexpr std::size_t most_bytes = 1 << 16;

std::string lower_extension(const std::string& file) {
  std::string extension = fs::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

std::string_view trimmed(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = line.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(blanks) + 1 - first);
}

std::string read_text(const std::string& file) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!fs::is_regular_file(file, ignored) || !stream) {
    throw Wrong(file, "cannot-read", "the file cannot be read");
  }
  std::string text(most_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most_bytes) {
    throw Wrong(file, "bad-texture-file", "the file is too long",
                "at most " + std::to_string(most_bytes) + " bytes");
  }
  return text;
}

/// The one line that counts.
std::string line_of(const std::string& file) {
  const std::string text = read_text(file);
  std::string found;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(at, end - at));
    at = end + 1;
    if (line.empty() || line.front() == '#') continue;
    if (!found.empty()) {
      throw Wrong(file, "bad-texture-file", "the file has several lines", "one",
                  '\'' + std::string(line) + '\'');
    }
    found = line;
  }
  return found;
}

}  // namespace

ImageName split_name(const std::string& name) {
  const std::size_t mark = name.find('?');
  ImageName split{name.substr(0, mark), {}};
  if (mark == std::string::npos) return split;
  std::string_view rest = std::string_view(name).substr(mark + 1);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('&'), rest.size());
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::size_t sign = part.find('=');
    if (sign == std::string_view::npos || sign == 0) {
      throw Wrong(split.file, "bad-query", "a part of the name behind '?' is not understood",
                  "key=value", '\'' + std::string(part) + '\'');
    }
    if (!split.values.emplace(part.substr(0, sign), part.substr(sign + 1)).second) {
      throw Wrong(split.file, "bad-query",
                  '\'' + std::string(part.substr(0, sign)) + "' is asked for twice");
    }
  }
  return split;
}

ImageName follow(const ImageName& name) {
  if (lower_extension(name.file) != ".mtlxtex") return name;
  ImageName meant = split_name(line_of(name.file));
  if (lower_extension(meant.file) != ".mtlx") {
    throw Wrong(name.file, "bad-texture-file", "the file names no document",
                "a line as 'marble.mtlx?output=NG_marble/base_color&size=4096'",
                '\'' + meant.file + '\'');
  }
  meant.file = (fs::path(name.file).parent_path() / meant.file).string();
  for (const auto& [key, value] : name.values) meant.values[key] = value;
  return meant;
}

bool is_graph_image(const std::string& file) {
  const std::string extension = lower_extension(file);
  return extension == ".mtlx" || extension == ".mtlxtex";
}

}  // namespace graph_image
