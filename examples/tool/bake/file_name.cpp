#include "examples/tool/bake/file_name.h"

#include <string_view>

namespace nacre::tool {

namespace {

constexpr std::string_view udim_field = "{udim}";
constexpr std::string_view end = ".{ext}";

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
    text.replace(at, what.size(), with);
  }
}

}  // namespace

bool check_file_name(const std::string& name, bool has_tiles, Diagnostics& diagnostics) {
  const auto refuse = [&](std::string expected) {
    diagnostics.error("bad-option", {}, "--name makes no names of images", std::move(expected),
                      name);
    return false;
  };
  std::string rest = name;
  for (const std::string_view field : {"{output}", "{udim}", "{ext}"}) replace_all(rest, field, "");
  if (rest.find_first_of("{}") != std::string::npos) return refuse("{output}, {udim} and {ext}");
  if (rest.find('/') != std::string::npos || rest.starts_with(".nacre-")) {
    return refuse("a name without a folder");
  }
  if (!name.ends_with(end)) return refuse("'.{ext}' at its end");
  if (name.find("{output}") == std::string::npos) return refuse("{output} in it");
  if (has_tiles && name.find(udim_field) == std::string::npos) return refuse("{udim} in it");
  return true;
}

std::string file_name(const std::string& name, const std::string& output, const std::string& tile,
                      const std::string& extension) {
  std::string text = name;
  if (tile.empty()) {
    for (const std::string before : {".", "_", "-"}) {
      replace_all(text, before + std::string(udim_field), "");
    }
  }
  replace_all(text, udim_field, tile);
  replace_all(text, end, extension);
  replace_all(text, "{ext}", extension.substr(1));
  replace_all(text, "{output}", output);
  return text;
}

}  // namespace nacre::tool
