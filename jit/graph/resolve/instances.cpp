#include "jit/graph/resolve/instances.h"

#include <fmt/format.h>

#include <functional>

#include "jit/document/inheritance.h"
#include "jit/document/value_text.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

// Graphs that implement nodes of graphs that implement nodes: deeper is a fault.
constexpr int max_context_depth = 256;

Source literal(Value value) {
  Source source;
  source.kind = Source::Kind::literal;
  source.value = std::move(value);
  return source;
}

std::string join(const Context* context, std::string_view name) {
  if (context == nullptr) return std::string(name);
  return context->path + '/' + std::string(name);
}

}  // namespace

std::size_t Instances::PlaceHash::operator()(const Place& place) const {
  const std::hash<const void*> hash;
  return hash(place.first) ^ ((hash(place.second) * 0x9E3779B97F4A7C15u) >> 7);
}

const Instance* Instances::of(const Element& element, const Context* context) {
  const auto [place, is_new] = of_element_.try_emplace({&element, context}, nullptr);
  if (!is_new) return place->second;
  const NodeDef* def = implementations_.nodedef_of(element);
  if (def == nullptr) return nullptr;
  Instance& instance = instances_.emplace_back();
  instance.element = &element;
  instance.def = def;
  instance.context = context;
  instance.path = join(context, element.name().empty() ? element.category() : element.name());
  instance.origin = &element;
  bytes_ += instance.path.size();
  return place->second = &instance;
}

Instance& Instances::add(const NodeDef& def, std::string path, const Element* origin) {
  Instance& instance = instances_.emplace_back();
  instance.def = &def;
  instance.path = std::move(path);
  instance.origin = origin;
  bytes_ += instance.path.size();
  return instance;
}

const Context* Instances::compound(const Element& graph, const Context* parent) {
  const auto [place, is_new] = compounds_.try_emplace({&graph, parent}, nullptr);
  if (!is_new) return place->second;
  Context& context = contexts_.emplace_back();
  context.graph = &graph;
  context.parent = parent;
  context.path = join(parent, graph.name());
  bytes_ += context.path.size();
  // A graph that implements a nodedef, looked at on its own: the nodedef's
  // defaults stand for its inputs.
  if (const NodeDef* def = definitions_.implemented_by(graph)) {
    context.instance = &add(*def, context.path, &graph);
    context.def = def;
  }
  return place->second = &context;
}

const Context* Instances::functional(const Instance& instance, const Element& graph) {
  const auto known = functionals_.find(&instance);
  if (known != functionals_.end()) return known->second;
  int depth = 0;
  for (const Context* at = instance.context; at != nullptr;) {
    const bool is_itself = at->graph == &graph;
    if (is_itself || ++depth > max_context_depth) {
      complaints_.error(is_itself ? "recursive-graph" : "too-deep", *instance.origin,
                        is_itself ? "the graph that implements the node contains the node itself"
                                  : "graphs that implement nodes are nested too deeply",
                        is_itself ? "" : fmt::format("at most {} levels", max_context_depth),
                        instance.path.substr(0, 200));
      functionals_.emplace(&instance, nullptr);
      return nullptr;
    }
    at = at->instance != nullptr ? at->instance->context : at->parent;
  }
  Context& context = contexts_.emplace_back();
  context.graph = &graph;
  context.instance = &instance;
  context.def = instance.def;
  context.path = instance.path;
  bytes_ += context.path.size();
  functionals_.emplace(&instance, &context);
  return &context;
}

const Element* Instances::of_variant(std::string_view category, std::string_view name,
                                     const Instance* instance) const {
  const auto fits = [&](std::string_view wanted, std::string_view own, std::string_view other) {
    return wanted.empty() || wanted == own || wanted == other;
  };
  for (auto choice = options_.variants.rbegin(); choice != options_.variants.rend(); ++choice) {
    const Element* set = document_.root().child(choice->variantset);
    const Element* variant = set == nullptr ? nullptr : set->child(choice->variant);
    const Element* child = variant == nullptr ? nullptr : variant->child(name);
    if (child == nullptr || child->category() != category) continue;
    if (instance == nullptr) return child;
    const Element& node = *instance->element;
    if (fits(set->attribute("node"), node.name(), node.category()) &&
        fits(set->attribute("nodedef"), instance->def->name, {})) {
      return child;
    }
  }
  return nullptr;
}

const Element* Instances::input(const Instance& instance, std::string_view name) const {
  if (!options_.variants.empty() && instance.element != nullptr &&
      &instance.element->document() == &document_) {
    const Type type = instance.def->outputs.empty() ? Type::none : instance.def->outputs[0].type;
    const bool is_shader = type >= Type::surfaceshader && type <= Type::lightshader;
    if (is_shader || instance.element->child(name) != nullptr) {
      if (const Element* input = of_variant("input", name, &instance)) return input;
    }
  }
  // An instance may inherit inputs from another of its class (Specification, "Shader Nodes").
  return instance.element == nullptr ? nullptr : find_input(*instance.element, name);
}

std::optional<std::uint32_t> Instances::output_index(const NodeDef& def, std::string_view name,
                                                     const Element& user, std::uint32_t leaf) {
  if (name.empty()) {
    if (def.outputs.size() == 1) return 0;
    // The leaves of one structure are one output.
    if (leaf != 0 && leaf <= def.outputs.size() && def.instance_type() != "multioutput") {
      return leaf - 1;
    }
    const std::string found =
        complaints_.is_lenient() ? fmt::format("taken: '{}'", def.outputs[0].name) : "";
    const bool takes_first = complaints_.tolerates(
        "output-required", user,
        fmt::format("'{}' has several outputs and none is named", def.category),
        "the first is taken", "output=\"NAME\"", found);
    return takes_first ? std::optional<std::uint32_t>(0) : std::nullopt;
  }
  for (std::uint32_t i = 0; i < def.outputs.size(); ++i) {
    const PortMember& member = def.outputs[i].member;
    if (member.port == name && member.leaf == leaf) return i;
  }
  std::string names;
  for (const NodeDefOutput& output : def.outputs) {
    names += (names.empty() ? "" : ", ") + std::string(output.name);
  }
  const std::string message = fmt::format("'{}' has no such output", def.category);
  const std::string found = fmt::format("'{}'", name);
  const std::string hint = near_hint(complaints_.diagnostics(), name, def.outputs,
                                     [](const NodeDefOutput& output) { return output.name; });
  if (def.outputs.size() == 1 && leaf == 0) {
    const bool takes_only = complaints_.tolerates("unknown-output", user, message,
                                                  "its only one is taken", names, found, hint);
    return takes_only ? std::optional<std::uint32_t>(0) : std::nullopt;
  }
  complaints_.error("unknown-output", user, message, names, found, hint);
  return std::nullopt;
}

const Instance* Instances::of_geomprop(std::string_view name, const Element& user) {
  const auto known = geomprops_.find(name);
  if (known != geomprops_.end()) return known->second;
  const Element* geomprop = definitions_.geompropdef(name);
  if (geomprop == nullptr) {
    complaints_.error("unknown-geomprop", user, "there is no geometric property of this name",
                      "the name of a <geompropdef>", fmt::format("'{}'", name),
                      near_hint(complaints_.diagnostics(), name, definitions_.geompropdef_names()));
    return nullptr;
  }
  const std::string_view type = geomprop->attribute("type");
  const std::string_view kind = geomprop->attribute("geomprop");
  const NodeDef* def = definitions_.nodedef(fmt::format("ND_{}_{}", kind, type));
  const bool is_custom = def == nullptr;
  if (is_custom) def = definitions_.nodedef(fmt::format("ND_geompropvalue_{}", type));
  // A document may have nodedefs of such names for something else.
  if (def == nullptr || def->outputs.size() != 1 || def->outputs[0].type_text != type) {
    complaints_.error("unknown-geomprop", *geomprop, "no node gives this geometric property", "",
                      fmt::format("{} of type {}", kind, type));
    return nullptr;
  }
  Instance& added = add(*def, std::string(name), &user);
  for (const NodeDefInput& input : def->inputs) {
    std::string_view text = geomprop->attribute(input.name);
    if (is_custom && input.name == "geomprop" && text.empty()) text = geomprop->name();
    if (text.empty()) continue;
    auto value = parse_value(input.type, text);
    if (!value) {
      complaints_.error("bad-value", *geomprop,
                        fmt::format("the {} does not fit the type {}", input.name, input.type_text),
                        expected_text(input.type), fmt::format("'{}'", text));
      return nullptr;
    }
    added.inputs.emplace_back(input.name, literal(std::move(*value)));
  }
  geomprops_.emplace(name, &added);
  return &added;
}

}  // namespace nacre
