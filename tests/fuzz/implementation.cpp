// Bytes as the text that implements a node of a document: an expression with inputs, a file
// of functions, or an expression where the node has none, by the first byte; a file that defines
// h_evaluate is a lobe's too. Checked, compiled and run like any document.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "jit/document/read.h"
#include "tests/fuzz/host.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/tree.h"

namespace {

using namespace nacre;

/// Ports of several kinds, and a node without inputs.
constexpr const char* before = R"(<materialx version="1.39">
  <nodedef name="ND_f" node="f">
    <input name="a" type="float" value="0.5"/><input name="b" type="vector3" value="1, 2, 3"/>
    <input name="n" type="integer" value="3"/><input name="c" type="color4" value="0, 1, 0, 1"/>
    <input name="m" type="matrix33" value="1,0,0,0,1,0,0,0,1"/><input name="on" type="boolean" value="true"/>
    <output name="out" type="float"/></nodedef>
  <nodedef name="ND_g" node="g"><output name="out" type="float"/></nodedef>
  <nodegraph name="G"><texcoord name="uv" type="vector2"/>
    <extract name="u" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
    <f name="x" type="float"><input name="a" type="float" nodename="u"/></f>
    <g name="y" type="float"/>
    <output name="o1" type="float" nodename="x"/><output name="o2" type="float" nodename="y"/>
  </nodegraph>
)";

/// A lobe, alone and below another.
constexpr const char* lobe = R"(
  <nodedef name="ND_h" node="h" bsdf="RT">
    <input name="weight" type="float" value="1"/><input name="c" type="color3" value="0.5, 0.7, 1"/>
    <input name="n" type="integer" value="3"/><input name="normal" type="vector3" defaultgeomprop="Nworld"/>
    <input name="tangent" type="vector3" defaultgeomprop="Tworld"/><output name="out" type="BSDF"/></nodedef>
  <implementation name="IM_h" nodedef="ND_h" target="genglsl" file="{}" function="h"/>
  <geomcolor name="tint" type="color3"/><dielectric_bsdf name="top" type="BSDF"/>
  <h name="b" type="BSDF"><input name="c" type="color3" nodename="tint"/></h>
  <layer name="l" type="BSDF"><input name="top" type="BSDF" nodename="top"/>
    <input name="base" type="BSDF" nodename="b"/></layer>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="l"/></surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/>
  </surfacematerial>
)";

void run(const std::string& text, const std::string& name) {
  Diagnostics diagnostics;
  const auto document = read_document_text(text, name, fuzz::read_options(), diagnostics);
  if ((document == nullptr) != diagnostics.has_errors()) {
    fuzz::fail("a document is refused without a reason, or read with an error");
  }
  if (document == nullptr) return;
  ShaderOptions options = fuzz::shader_options();
  fuzz::shade_everything(*document, options);
}

std::string implementation(const std::string& nodedef, const std::string& code) {
  fuzz::Tree tree{"implementation", {{"name", "IM"}, {"nodedef", nodedef}}, {}};
  tree.set("target", "nacre");
  tree.set("sourcecode", code);
  return fuzz::write_tree(tree);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  static const fuzz::MemoryFile file(".glsl");
  const std::string text(fuzz::as_text(data + 1, size - 1));
  const std::filesystem::path path = file.path();
  std::string document = before;
  if (data[0] % 3 == 0) {
    document += implementation("ND_f", text);
  } else if (data[0] % 3 == 2) {
    document += implementation("ND_g", text);
  } else {
    file.write(text);
    for (const char* node : {"f", "g"}) {
      document += std::string("<implementation name=\"IM_") + node + "\" nodedef=\"ND_" + node +
                  "\" target=\"genglsl\" file=\"" + path.filename().string() + "\" function=\"" +
                  node + "\"/>\n";
    }
    if (text.find("h_evaluate") != std::string::npos) {
      std::string nodes = lobe;
      document += nodes.replace(nodes.find("{}"), 2, path.filename().string());
    }
  }
  run(document + "</materialx>\n", (path.parent_path() / "input.mtlx").string());
  return 0;
}
