#include "examples/tool/size.h"

#include <charconv>
#include <string_view>

namespace nacre::tool {

namespace {

bool parse_extent(std::string_view text, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= 1 && value <= 65536;
}

}  // namespace

bool parse_size(const std::string& text, int& width, int& height, Diagnostics& diagnostics) {
  const std::string_view view(text);
  const std::size_t cross = view.find('x');
  const bool ok = cross == std::string_view::npos
                      ? parse_extent(view, width) && parse_extent(view, height)
                      : parse_extent(view.substr(0, cross), width) &&
                            parse_extent(view.substr(cross + 1), height);
  if (!ok) {
    diagnostics.error("bad-size", {}, "not an image size", "N or WxH with 1 to 65536 pixels",
                      '"' + text + '"');
  }
  return ok;
}

}  // namespace nacre::tool
