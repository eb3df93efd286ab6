#include "jit/record/bodies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "nodes/nodes.h"
#include "pbs/closure_nodes.h"
#include "pbs/library.h"

namespace nacre {

namespace {

bool makes_closure(const NodeDef& def) {
  return std::any_of(def.outputs.begin(), def.outputs.end(), [](const NodeDefOutput& output) {
    return is_closure(output.type) || output.type == Type::surfaceshader ||
           output.type == Type::displacementshader || output.type == Type::volumeshader ||
           output.type == Type::lightshader || output.type == Type::material;
  });
}

const NodeBody* of_category(const std::vector<NodeBody>& bodies, std::string_view category) {
  const auto found = std::find_if(bodies.begin(), bodies.end(),
                                  [&](const NodeBody& body) { return body.category == category; });
  return found == bodies.end() ? nullptr : &*found;
}

/// The folder of the data library among those that definitions were read from, with a '/';
/// "" where none is like it, so that all of them count as such.
std::string standard_folder(const Definitions& library) {
  for (const NodeDef* def : library.all()) {
    const std::string& file = def->element->document().file_of(*def->element);
    const std::size_t at = file.rfind("/stdlib/");
    if (at != std::string::npos) return file.substr(0, at + 1);
  }
  return {};
}

/// Whether a file is one of pbs/library.
bool is_own(const std::string& file) {
  return std::ranges::any_of(own_library(), [&](const auto& text) { return text.first == file; });
}

/// Category, inputs and outputs with their types, whatever the order.
std::string signature(const NodeDef& def) {
  std::vector<std::string> ports;
  for (const NodeDefInput& input : def.inputs) {
    ports.push_back(fmt::format("|{}:{}", input.name, input.type_text));
  }
  for (const NodeDefOutput& output : def.outputs) {
    ports.push_back(fmt::format("|>{}:{}", output.name, output.type_text));
  }
  std::sort(ports.begin(), ports.end());
  return fmt::format("{}{}", def.category, fmt::join(ports, ""));
}

}  // namespace

Bodies::Bodies(const Definitions& library) {
  const std::string standard = standard_folder(library);
  const auto is_standard = [&](const NodeDef& def) {
    const std::string& file = def.element->document().file_of(*def.element);
    return file.starts_with(standard) || is_own(file);
  };
  std::unordered_set<std::string> made_for;  // Only asked where there are node packs.
  const auto fits = [&](const NodeDef& def) {
    if (is_standard(def)) return true;
    if (made_for.empty()) {
      for (const NodeDef* one : library.all()) {
        if (is_standard(*one)) made_for.insert(signature(*one));
      }
    }
    return made_for.contains(signature(def));
  };
  for (const NodeDef* def : library.all()) {
    const auto& bodies = makes_closure(*def) ? closure_nodes() : standard_nodes();
    const NodeBody* body = of_category(bodies, def->category);
    if (body == nullptr) continue;
    if (library.graph_of(*def) != nullptr && !body->replaces_graphs) continue;
    if (!fits(*def)) continue;
    by_nodedef_.emplace(def->name, Binding{body, def});
  }
}

bool Bodies::add(const std::string& nodedef, std::function<void(NodeCall&)> record,
                 const Definitions& library) {
  const NodeDef* def = library.nodedef(nodedef);
  if (def == nullptr) return false;
  added_.push_back({def->category, std::move(record), true});
  by_nodedef_[nodedef] = {&added_.back(), def, true};
  return true;
}

const Bodies::Binding* Bodies::binding(std::string_view nodedef) const {
  const auto found = by_nodedef_.find(std::string(nodedef));
  return found == by_nodedef_.end() ? nullptr : &found->second;
}

const NodeBody* Bodies::find(std::string_view nodedef) const {
  const Binding* found = binding(nodedef);
  return found == nullptr ? nullptr : found->body;
}

}  // namespace nacre
