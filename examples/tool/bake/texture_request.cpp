#include "examples/tool/bake/texture_request.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "examples/tool/size.h"

namespace nacre::tool {

namespace {

constexpr int most_texels = 65536;

/// A whole number of that range from an attribute; true if it is not there.
bool read_number(const Element& output, std::string_view name, int least, int most, int& number,
                 Diagnostics& diagnostics) {
  if (!output.has_attribute(name)) return true;
  const std::string_view text = output.attribute(name);
  const char* end = text.data() + text.size();
  int value = 0;
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc{} && last == end && value >= least && value <= most) {
    number = value;
    return true;
  }
  diagnostics.error("bad-output", location(output),
                    "the attribute " + std::string(name) + " cannot be used",
                    std::to_string(least) + " to " + std::to_string(most), std::string(text));
  return false;
}

bool read_output(const Element& output, const TextureRequest& request, TextureSettings& settings,
                 Diagnostics& diagnostics) {
  bool ok = true;
  if (request.size.empty()) {
    ok = read_number(output, "width", 1, most_texels, settings.width, diagnostics) && ok;
    ok = read_number(output, "height", 1, most_texels, settings.height, diagnostics) && ok;
  }
  if (request.bits == 0) {
    ok = read_number(output, "bitdepth", 1, 64, settings.encoding.bits, diagnostics) && ok;
  }
  settings.encoding.colorspace = output.attribute("colorspace");
  return ok;
}

}  // namespace

void TextureRequest::add(CLI::App& command) {
  command.add_option("--size", size, "Texels (default: an output's width and height, else 1024)")
      ->type_name("N|WxH");
  command
      .add_option("--bitdepth", bits,
                  "Bits of a channel: 8 or 16 in png, 16 or 32 in exr and tx (default: an "
                  "output's bitdepth, else 8 and 32)")
      ->check(CLI::IsMember({8, 16, 32}));
  command
      .add_option("--format", format,
                  "exr and tx hold floats, png whole numbers (default: exr, but png for an "
                  "output of bitdepth 8)")
      ->check(CLI::IsMember({"exr", "png", "tx"}));
  command
      .add_option("--vectors", vectors,
                  "How vectors are written: raw, or encoded as (v + 1) / 2, as normalmap reads "
                  "unit vectors; png holds none that are negative otherwise (--document writes "
                  "what its nodes read)")
      ->check(CLI::IsMember({"raw", "encoded"}))
      ->capture_default_str();
  command
      .add_option("--name", name,
                  "How images are called, with {output}, {udim} and {ext} in braces; what has no "
                  "tiles is called without {udim} and the '.', '_' or '-' before it")
      ->type_name("TEXT")
      ->capture_default_str();
  command
      .add_flag("--clip", clip,
                "With --document, cut numbers off at the ends of what a texture holds, with a "
                "warning, where that is an error otherwise")
      ->needs(command.get_option("--document"));
}

bool TextureRequest::check(Diagnostics& diagnostics) const {
  int width = 0;
  int height = 0;
  return size.empty() || parse_size(size, width, height, diagnostics);
}

bool texture_settings(const TextureRequest& request, const Element* output,
                      TextureSettings& settings, Diagnostics& diagnostics) {
  settings = {};
  settings.encoding.bits = request.bits;
  settings.encoding.software = "nacre " NACRE_TOOL_VERSION;
  settings.encoding.document = request.document;
  settings.encoding.encodes_vectors = request.vectors == "encoded";
  if (!request.size.empty()) {
    parse_size(request.size, settings.width, settings.height, diagnostics);
  }
  if (output != nullptr && !read_output(*output, request, settings, diagnostics)) return false;
  const bool is_bytes = settings.encoding.bits == 8;
  settings.extension = request.format.empty() ? (is_bytes ? ".png" : ".exr") : "." + request.format;
  return true;
}

}  // namespace nacre::tool
