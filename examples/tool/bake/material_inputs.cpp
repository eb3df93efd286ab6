#include "examples/tool/bake/material_inputs.h"

#include <algorithm>

#include "jit/document/inheritance.h"
#include "jit/graph/find.h"
#include "jit/graph/resolve/feed.h"
#include "runtime/near_names.h"

namespace nacre::tool {

std::vector<std::string> material_inputs(const Opened& opened, const std::string& material,
                                         bool lenient, Diagnostics& diagnostics) {
  const Document& document = *opened.document;
  std::string known;
  for (const FoundMaterial& found : find_materials(document)) {
    known += (known.empty() ? "" : ", ") + found.name;
    if (found.name != material) continue;
    Diagnostics elsewhere;  // Compiling says what is wrong with definitions.
    const Definitions definitions(document, &opened.system->library().definitions(), elsewhere);
    Complaints complaints(diagnostics, lenient);
    std::vector<std::string> names;
    const Element* surface = find_input(*document.root().child(material), "surfaceshader");
    if (surface == nullptr) return names;
    const Feed shader = find_source_node(*surface, definitions, complaints);
    if (shader.connection.kind != Connection::Kind::node) return names;
    for (const Element* input : find_inputs(*shader.connection.target, diagnostics)) {
      const Connection connection = find_feed(*input, definitions, complaints).connection;
      if (connection.kind != Connection::Kind::output) continue;
      std::string name = element_path(*connection.target);
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(std::move(name));
      }
    }
    return names;
  }
  diagnostics.error("unknown-material", {document.files().front(), 0, 0, {}},
                    "there is no material '" + material + "'",
                    known.empty() ? "a material" : "one of " + known, {},
                    near_hint(diagnostics, material, find_materials(document),
                              [](auto& each) { return std::string_view(each.name); }));
  return {};
}

}  // namespace nacre::tool
