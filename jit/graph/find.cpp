#include "jit/graph/find.h"

#include <string_view>
#include <unordered_set>

#include "jit/document/inheritance.h"
#include "jit/document/select.h"

namespace nacre {

namespace {

void add_outputs_of(const Element& scope, std::vector<FoundOutput>& outputs) {
  for (const Element& child : scope.children()) {
    if (child.category() != "output") continue;
    const Type type = parse_type(child.attribute("type")).value_or(Type::none);
    outputs.push_back({element_path(child), type, location(child)});
  }
}

// Graphs that an <implementation> ties to a nodedef.
std::unordered_set<std::string_view> implementing_graphs(const Document& document) {
  std::unordered_set<std::string_view> names;
  for (const Element& child : document.root().children()) {
    if (child.category() == "implementation") names.insert(child.attribute("nodegraph"));
  }
  return names;
}

std::string source_of(const Element& material, std::string_view input_name) {
  const Element* input = find_input(material, input_name);
  if (input == nullptr) return {};
  for (std::string_view attribute : {"nodename", "nodegraph", "interfacename", "output"}) {
    if (!input->attribute(attribute).empty()) return std::string(input->attribute(attribute));
  }
  return {};
}

bool is_shader(Type type) {
  return type == Type::surfaceshader || type == Type::displacementshader ||
         type == Type::volumeshader || type == Type::lightshader;
}

// The shader output of a node, or none.
Type shader_type(const Element& node, const Definitions& definitions) {
  const std::string_view text = node.attribute("type");
  if (text != "multioutput") return parse_type(text).value_or(Type::none);
  Diagnostics ignored;
  const NodeDef* def = find_nodedef(node, definitions, ignored);
  if (def == nullptr) return Type::none;
  for (const NodeDefOutput& output : def->outputs) {
    if (is_shader(output.type)) return output.type;
  }
  return Type::none;
}

}  // namespace

std::vector<FoundOutput> find_outputs(const Document& document) {
  std::vector<FoundOutput> outputs;
  const auto implementing = implementing_graphs(document);
  for (const Element& child : document.root().children()) {
    const bool is_compound = child.category() == "nodegraph" && !child.has_attribute("nodedef") &&
                             !implementing.contains(child.name());
    if (is_compound) add_outputs_of(child, outputs);
  }
  add_outputs_of(document.root(), outputs);
  return outputs;
}

const Element* find_element(const Document& document, std::string_view path) {
  const Element* at = &document.root();
  while (at != nullptr && !path.empty()) {
    const std::size_t slash = path.find('/');
    at = at->child(path.substr(0, slash));
    path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
  }
  return at;
}

SourceLocation location_of(const Document& document, std::string_view path) {
  const Element* element = find_element(document, path);
  SourceLocation where = location(element != nullptr ? *element : document.root());
  if (element == nullptr) where.path = path;
  return where;
}

std::vector<FoundMaterial> find_materials(const Document& document) {
  std::vector<FoundMaterial> materials;
  for (const Element& child : document.root().children()) {
    if (!is_node(child) || child.attribute("type") != "material") continue;
    FoundMaterial& material = materials.emplace_back();
    material.name = child.name();
    material.surfaceshader = source_of(child, "surfaceshader");
    material.backsurfaceshader = source_of(child, "backsurfaceshader");
    material.displacementshader = source_of(child, "displacementshader");
    material.volumeshader = source_of(child, "volumeshader");
    material.lightshader = source_of(child, "lightshader");
    material.where = location(child);
  }
  return materials;
}

std::vector<FoundOutput> find_loose_shaders(const Document& document,
                                            const Definitions& definitions) {
  std::unordered_set<std::string_view> read;
  const auto note = [&](const Element& port) { read.insert(port.attribute("nodename")); };
  for (const Element& child : document.root().children()) {
    if (child.category() == "output") note(child);
    for (const Element& port : child.children()) {
      // Inside a graph only the graph's own inputs look outwards.
      if (port.category() == "input") note(port);
    }
  }
  std::vector<FoundOutput> shaders;
  for (const Element& child : document.root().children()) {
    if (!is_node(child) || read.contains(child.name())) continue;
    const Type type = shader_type(child, definitions);
    if (is_shader(type)) shaders.push_back({std::string(child.name()), type, location(child)});
  }
  return shaders;
}

}  // namespace nacre
