#include "jit/api/nodedef_list.h"

#include <cstdint>

#include "jit/document/nodedef.h"

namespace nacre::api {

namespace {

/// The port itself for what is no leaf of a structure.
std::string_view attribute_of(const Element* element, std::string_view name) {
  return element != nullptr ? element->attribute(name) : std::string_view{};
}

}  // namespace

NodeDefList::NodeDefList(const ShadingSystem& system) {
  const GraphOptions options = system.graph_options({});
  for (const NodeDef* def : system.library().definitions().all()) {
    Row row;
    row.about.name = texts_.keep(def->name);
    row.about.category = texts_.keep(def->category);
    row.about.group = texts_.keep(def->nodegroup);
    row.about.version = texts_.keep(def->version);
    row.about.document = texts_.keep(attribute_of(def->element, "doc"));
    for (const NodeDefInput& input : def->inputs) row.inputs.push_back(port(input));
    for (const NodeDefOutput& output : def->outputs) row.outputs.push_back(port(output));
    row.about.input_count = row.inputs.size();
    row.about.output_count = row.outputs.size();
    row.about.has_body = options.is_native(def->name);
    by_name_.emplace(row.about.name, rows_.size());
    rows_.push_back(std::move(row));
  }
}

std::size_t NodeDefList::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found != by_name_.end() ? found->second : SIZE_MAX;
}

nacre_port NodeDefList::port(const NodeDefInput& input) {
  const InputUi ui = ui_of(input);
  nacre_port made{};
  made.name = texts_.keep(input.name);
  made.type = texts_.keep(input.type_text);
  made.value = texts_.keep(attribute_of(input.element, "value"));
  made.geomprop = texts_.keep(input.defaultgeomprop);
  made.label = texts_.keep(ui.label);
  made.folder = texts_.keep(ui.folder);
  made.unit = texts_.keep(input.unit);
  made.document = texts_.keep(ui.doc);
  made.is_uniform = input.uniform;
  return made;
}

nacre_port NodeDefList::port(const NodeDefOutput& output) {
  nacre_port made{};
  made.name = texts_.keep(output.name);
  made.type = texts_.keep(output.type_text);
  made.value = texts_.keep(attribute_of(output.element, "default"));
  made.geomprop = texts_.keep(output.default_geomprop);
  made.label = made.folder = made.unit = "";
  made.document = texts_.keep(attribute_of(output.element, "doc"));
  return made;
}

}  // namespace nacre::api
