#include "examples/tool/render/missing_material.h"

#include <algorithm>

#include "jit/graph/check/check.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

const Element* find_named(const Element& parent, const std::string& name) {
  if (const Element* child = parent.child(name)) return child;
  for (const Element& child : parent.children()) {
    if (const Element* found = child.child(name)) return found;
  }
  return nullptr;
}

}  // namespace

void explain_missing_material(const Opened& opened, const std::string& name,
                              const ShaderOptions& options, Diagnostics& diagnostics) {
  const Element* element = find_named(opened.document->root(), name);
  if (element == nullptr) return;
  // What is a material, and was not compiled for other reasons, has had its errors.
  const auto is_it = [&](const FoundMaterial& found) { return found.name == name; };
  if (std::ranges::any_of(find_materials(*opened.document), is_it)) return;
  const std::string type(element->attribute("type"));
  diagnostics.error("not-a-material", location(*element),
                    "what is called '" + name + "' is no material of the document",
                    "a node of type material at the document's root",
                    "a " + std::string(element->category()) +
                        (type.empty() ? " without a type" : " of type " + type));
  Diagnostics all;
  check_document(*opened.document, opened.system->library(), opened.system->graph_options(options),
                 all);
  const std::string path = location(*element).path;
  for (const Diagnostic& each : all.all()) {
    if (each.where.path == path || each.where.path.starts_with(path + '/')) diagnostics.add(each);
  }
}

}  // namespace nacre::tool
