#include "examples/tool/render/not_rendered.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "examples/render/mesh.h"
#include "jit/document/inheritance.h"
#include "jit/document/select.h"
#include "jit/graph/resolve/feed.h"

namespace nacre::tool {

namespace {

/// Whether two texts write the same numbers, or are the same.
bool same_value(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const std::string first(a), second(b);
  const char *x = first.c_str(), *y = second.c_str();
  while (*x != '\0' && *y != '\0') {
    char *x_end = nullptr, *y_end = nullptr;
    if (std::strtod(x, &x_end) != std::strtod(y, &y_end) || x_end == x || y_end == y) return false;
    const auto skip = [](const char* p) { return p + std::string_view(p).find_first_not_of(", "); };
    x = *x_end == '\0' ? x_end : skip(x_end);
    y = *y_end == '\0' ? y_end : skip(y_end);
  }
  return *x == *y;
}

/// Inputs of its nodedef that a graph reads.
std::set<std::string_view> read_inputs(const Element& graph) {
  std::set<std::string_view> names;
  for (const Element& node : graph.children()) {
    names.insert(node.attribute("interfacename"));
    for (const Element& input : node.children()) names.insert(input.attribute("interfacename"));
  }
  return names;
}

}  // namespace

NotRendered::NotRendered(const Opened& opened, Diagnostics& diagnostics)
    : opened_(opened), diagnostics_(diagnostics), definitions_([&]() -> Definitions {
        Diagnostics known;  // The compiler reports them.
        return Definitions(*opened.document, &opened.system->library().definitions(), known);
      }()) {}

void NotRendered::look_at_material(const std::string& name, const MaterialKernels& kernels) {
  if (!said_.insert(name).second) return;
  const Element* element = opened_.document->root().child(name);
  const SourceLocation where = element == nullptr
                                   ? SourceLocation{opened_.document->files().front(), 0, 0, name}
                                   : location(*element);
  for (const std::string& line : kernels.not_modelled) {
    diagnostics_.warning("not-modelled", where, "a part of the material is not rendered", {}, line);
  }
  if (kernels.volume && kernels.has_surface) {
    diagnostics_.warning("volume-not-rendered", where,
                         "the volume of a material that has a surface is not rendered");
  }
  if (kernels.has_volume && !kernels.has_surface && !kernels.volume) {
    diagnostics_.warning("empty-volume", where,
                         "the volume neither absorbs, scatters nor emits: nothing is there",
                         "a vdf with coefficients above 0, or an edf");
  }
  if (element == nullptr) return;
  for (const std::string_view side : {"surfaceshader", "backsurfaceshader"}) {
    if (const Element* input = find_input(*element, side)) look_at_shader(*input);
  }
}

void NotRendered::look_at_displaced(const std::string& material,
                                    const std::vector<const host::Mesh*>& meshes, bool displaces) {
  for (const host::Mesh* mesh : meshes) {
    if (displaces && !mesh->is_fibres()) continue;
    diagnostics_.warning("displacement-not-rendered", {},
                         "'" + mesh->object_name + "' stays where it is: the displacement of '" +
                             material + "' is not rendered",
                         mesh->is_fibres() ? "triangles" : "--dice above 0");
  }
}

void NotRendered::look_at_solids(const std::string& material,
                                 const std::vector<const host::Mesh*>& meshes) {
  for (const host::Mesh* mesh : meshes) {
    if (mesh->is_fibres() || host::is_closed(*mesh)) continue;
    diagnostics_.warning("open-solid", {},
                         "light that enters '" + mesh->object_name +
                             "' may never leave it: material '" + material + "' is solid",
                         "a mesh without a border, or a thin-walled material");
  }
}

/// The node that an input of a material leads to.
void NotRendered::look_at_shader(const Element& input) {
  Diagnostics known;
  Complaints complaints(known, true);
  const Connection shader = find_source_node(input, definitions_, complaints).connection;
  if (shader.kind != Connection::Kind::node) return;
  if (said_.insert('/' + element_path(*shader.target)).second) look_at_inputs(*shader.target);
}

void NotRendered::look_at_inputs(const Element& shader) {
  Diagnostics known;
  const NodeDef* def = find_nodedef(shader, definitions_, known);
  const Element* graph = def == nullptr ? nullptr : definitions_.graph_of(*def);
  if (graph == nullptr) return;
  const std::set<std::string_view> read = read_inputs(*graph);
  for (const Element& input : shader.children()) {
    const NodeDefInput* port = def->input(input.name());
    if (input.category() != "input" || port == nullptr || read.contains(input.name())) continue;
    if (input.has_attribute("value") && port->element != nullptr &&
        same_value(input.attribute("value"), port->element->attribute("value"))) {
      continue;
    }
    diagnostics_.warning("input-not-rendered", location(input),
                         "the input is not rendered: nothing in the graph of the node reads it", {},
                         std::string(graph->name()));
  }
}

}  // namespace nacre::tool
