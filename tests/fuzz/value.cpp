// Bytes as the value of an input, of each type and for each use, by the first byte.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "jit/document/read.h"
#include "tests/fuzz/host.h"
#include "tests/fuzz/memory_file.h"

namespace {

struct Use {
  const char* category;
  const char* input;
  const char* type;
  const char* result;
};

constexpr std::array uses{
    Use{"constant", "value", "float", "float"},
    Use{"constant", "value", "integer", "integer"},
    Use{"constant", "value", "boolean", "boolean"},
    Use{"constant", "value", "color3", "color3"},
    Use{"constant", "value", "color4", "color4"},
    Use{"constant", "value", "vector2", "vector2"},
    Use{"constant", "value", "vector3", "vector3"},
    Use{"constant", "value", "vector4", "vector4"},
    Use{"constant", "value", "matrix33", "matrix33"},
    Use{"constant", "value", "matrix44", "matrix44"},
    Use{"constant", "value", "string", "string"},
    Use{"image", "file", "filename", "color3"},
    Use{"tiledimage", "file", "filename", "float"},
    Use{"image", "framerange", "string", "color3"},
    Use{"image", "uaddressmode", "string", "color3"},
    Use{"geompropvalue", "geomprop", "string", "float"},
    Use{"geomcolor", "index", "integer", "color3"},
    Use{"texcoord", "index", "integer", "vector2"},
    Use{"position", "space", "string", "vector3"},
    Use{"fractal3d", "octaves", "integer", "float"},
    Use{"switch", "which", "integer", "float"},
    Use{"extract", "index", "integer", "float"},
};

/// As XML takes it: what has a meaning there, or none at all, by number.
std::string escaped(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const bool plain = static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '<' && c != '&';
    text += plain ? std::string(1, c) : "&#" + std::to_string(static_cast<unsigned char>(c)) + ";";
  }
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  if (size == 0) return 0;
  const Use& use = uses[data[0] % uses.size()];
  const std::string value = escaped(fuzz::as_text(data + 1, size - 1));
  const std::string type = use.type;
  const std::string text = std::string("<materialx version=\"1.39\"><nodegraph name=\"G\">") +
                           "<input name=\"i\" type=\"" + type + "\" value=\"" + value + "\"/>" +
                           "<" + use.category + " name=\"n\" type=\"" + use.result +
                           "\"><input name=\"" + use.input + "\" type=\"" + type + "\" " +
                           (data[0] >= 128 ? "interfacename=\"i\"" : "value=\"" + value + "\"") +
                           "/></" + use.category + "><output name=\"o\" type=\"" + use.result +
                           "\" nodename=\"n\"/></nodegraph></materialx>";
  Diagnostics diagnostics;
  const auto document = read_document_text(text, "input.mtlx", fuzz::read_options(), diagnostics);
  if ((document == nullptr) != diagnostics.has_errors()) {
    fuzz::fail("a document is refused without a reason, or read with an error");
  }
  if (document != nullptr) fuzz::shade_everything(*document);
  return 0;
}
