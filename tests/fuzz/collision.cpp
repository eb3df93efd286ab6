// Bytes as the choices by which a document takes names of the data library for its own
// nodedefs: with other ports, other types, another node, its own or no implementation.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "jit/document/read.h"
#include "tests/fuzz/host.h"
#include "tests/fuzz/random_document.h"
#include "tests/fuzz/splice.h"

namespace {

using namespace nacre;
using fuzz::Tree;

constexpr const char* types[] = {"float",         "color3",   "vector2",  "integer",
                                 "boolean",       "string",   "matrix44", "BSDF",
                                 "surfaceshader", "filename", "vector4",  "EDF"};

std::string attribute(const Tree& tree, std::string_view name) {
  const std::string* value = tree.find(name);
  return value != nullptr ? *value : std::string();
}

/// The nodedef of the library, changed.
Tree stolen_nodedef(const Tree& original, fuzz::Bytes& bytes) {
  Tree nodedef = original;
  if (bytes.flip()) nodedef.set("node", "stolen");
  const std::uint32_t changes = bytes.below(4);
  for (std::uint32_t i = 0; i < changes && !nodedef.children.empty(); ++i) {
    const auto at = bytes.below(static_cast<std::uint32_t>(nodedef.children.size()));
    Tree& port = nodedef.children[at];
    switch (bytes.below(5)) {
      case 0: port.set("type", types[bytes.below(std::size(types))]); break;
      case 1: port.set("name", "p" + std::to_string(bytes.below(3))); break;
      case 2: nodedef.children.push_back(Tree(port)); break;
      case 3: nodedef.children.erase(nodedef.children.begin() + at); break;
      default: std::swap(port, nodedef.children[0]);
    }
  }
  return nodedef;
}

Tree instance(const Tree& nodedef, fuzz::Bytes& bytes) {
  Tree node{attribute(nodedef, "node"), {{"name", "x"}}, {}};
  std::string type = "float";
  for (const Tree& port : nodedef.children) {
    if (port.category == "output") type = attribute(port, "type");
    if (port.category == "input" && bytes.flip()) node.children.push_back(port);
  }
  if (bytes.flip()) node.set("nodedef", attribute(nodedef, "name"));
  node.set("type", bytes.below(6) == 0 ? "multioutput" : type);
  return node;
}

void add_implementation(const Tree& nodedef, fuzz::Bytes& bytes, Tree& root) {
  const std::string name = attribute(nodedef, "name");
  switch (bytes.below(4)) {
    case 0:
      root.children.push_back({"implementation",
                               {{"name", "IM_stolen"},
                                {"nodedef", name},
                                {"target", "nacre"},
                                {"sourcecode", bytes.flip() ? "{{in}} * 2.0" : "1.0"}},
                               {}});
      break;
    case 1: {
      Tree graph{"nodegraph", {{"name", "NG_stolen"}, {"nodedef", name}}, {}};
      graph.children.push_back({"constant", {{"name", "c"}, {"type", "float"}}, {}});
      for (const Tree& port : nodedef.children) {
        if (port.category != "output") continue;
        graph.children.push_back(port);
        graph.children.back().set("nodename", "c");
      }
      root.children.push_back(std::move(graph));
      break;
    }
    default: break;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes({data, size});
  const auto& nodedefs = fuzz::project_splicer().library_nodedefs();
  Tree root{"materialx", {{"version", "1.39"}}, {}};
  const std::uint32_t count = 1 + bytes.below(3);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Tree& original = *nodedefs[bytes.below(static_cast<std::uint32_t>(nodedefs.size()))];
    const Tree nodedef = stolen_nodedef(original, bytes);
    Tree node = instance(nodedef, bytes);
    node.set("name", "x" + std::to_string(i));
    add_implementation(nodedef, bytes, root);
    Tree output{
        "output", {{"name", "o" + std::to_string(i)}, {"nodename", *node.find("name")}}, {}};
    output.set("type", attribute(node, "type"));
    root.children.push_back(nodedef);
    root.children.push_back(std::move(node));
    root.children.push_back(std::move(output));
  }
  Diagnostics diagnostics;
  const auto document =
      read_document_text(fuzz::write_tree(root), "input.mtlx", fuzz::read_options(), diagnostics);
  if ((document == nullptr) != diagnostics.has_errors()) {
    fuzz::fail("a document is refused without a reason, or read with an error");
  }
  if (document != nullptr) fuzz::shade_everything(*document);
  return 0;
}
