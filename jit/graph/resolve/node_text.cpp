#include "jit/graph/resolve/node_text.h"

#include <algorithm>

#include "jit/document/document.h"

namespace nacre {

bool is_lobe(const NodeDef& def) {
  return def.outputs.size() == 1 && def.outputs.front().type == Type::bsdf;
}

bool reads_image(const NodeDef& def) {
  return std::ranges::any_of(
      def.inputs, [](const NodeDefInput& input) { return input.type == Type::filename; });
}

bool may_be_text(const NodeDef& def) {
  if (is_lobe(def)) return true;
  return std::all_of(def.outputs.begin(), def.outputs.end(),
                     [](const NodeDefOutput& output) { return is_numeric(output.type); });
}

NodeText node_text(const NodeDef& def, const Element& implementation) {
  NodeText source;
  source.nodedef = def.name;
  source.file = implementation.attribute("file");
  source.text = implementation.attribute("sourcecode");
  source.function = implementation.attribute("function");
  source.document = implementation.document().file_of(implementation);
  source.where = location(implementation);
  if (is_lobe(def)) source.sides = def.element->attribute("bsdf");
  for (const NodeDefInput& input : def.inputs) {
    if (!is_text(input.type) || input.enums.empty()) continue;
    source.enums.emplace_back(input.name,
                              std::vector<std::string>(input.enums.begin(), input.enums.end()));
  }
  return source;
}

}  // namespace nacre
