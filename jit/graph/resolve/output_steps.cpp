// What nodes of the Graph, and outputs of nodes, come to.
#include <fmt/format.h>

#include "jit/graph/resolve/resolver.h"

namespace nacre {

namespace {

const NodeDefInput& disable_input() {
  static const NodeDefInput input = [] {
    NodeDefInput made;
    made.name = "disable";
    made.type = Type::boolean;
    made.uniform = true;
    return made;
  }();
  return input;
}

}  // namespace

std::optional<Resolver::Key> Resolver::step_node(Frame& frame) {
  const Instance& instance = *static_cast<const Instance*>(frame.key.subject);
  const NodeDef& def = *instance.def;
  if (frame.next_input < def.inputs.size()) {
    return Key{Kind::input, frame.next_input++, &instance, nullptr};
  }

  GraphNode node;
  node.category = def.category;
  node.nodedef = def.name;
  node.path = instance.path;
  node.where = location(*instance.origin);
  for (std::uint32_t i = 0; i < def.inputs.size(); ++i) {
    const Resolved& result = slots_.at({Kind::input, i, &instance, nullptr}).result;
    if (result.failed) frame.result.failed = true;
    bytes_ += bytes_of(result.source);
    node.inputs.push_back({std::string(def.inputs[i].name), def.inputs[i].type, result.source});
    // Nobody else asks for it, but for what the file of a texture is said to hold.
    if (def.inputs[i].type != Type::filename) slots_.erase({Kind::input, i, &instance, nullptr});
  }
  bytes_ += 2 * node.path.size();
  for (const NodeDefOutput& output : def.outputs) {
    node.outputs.push_back({std::string(output.name), output.type,
                            output.has_default ? output.default_value : Value{}});
  }
  if (frame.result.failed) return std::nullopt;
  literals_.choose_frame(node, *instance.origin);
  frame.result.source.kind = Source::Kind::link;
  frame.result.source.node = static_cast<std::uint32_t>(graph_.nodes.size());
  graph_.nodes.push_back(std::move(node));
  if (implementations_.runs_source(def)) add_source(def);
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::step_output(Frame& frame) {
  const Instance& instance = *static_cast<const Instance*>(frame.key.subject);
  switch (frame.stage) {
    case Stage::start: return start_output(frame, instance);
    case Stage::received: {
      const std::optional<Key> next = finish_native_output(frame, instance);
      if (instance.def->outputs.size() == 1) slots_.erase(frame.waiting_for);
      return next;
    }
    case Stage::switched: {
      Resolved disable = waited(frame);
      if (!disable.failed) literals_.make_uniform(disable_input(), *instance.origin, disable);
      frame.result.failed = disable.failed;
      if (disable.failed) return std::nullopt;
      const std::vector<std::int32_t>& value = disable.source.value.ints;
      if (value.empty() || value[0] == 0) return start_enabled_output(frame, instance);
      return pass_through(frame, instance);
    }
    default: {
      const Type type = instance.def->outputs[frame.key.index].type;
      frame.result = waited(frame);
      if (!frame.result.failed && frame.result.type != type) {
        complaints_.error("type-mismatch", *instance.origin,
                          fmt::format("the graph of '{}' gives another type than its nodedef says",
                                      instance.def->name),
                          std::string(type_name(type)), std::string(type_name(frame.result.type)));
        frame.result.failed = true;
      }
      return std::nullopt;
    }
  }
}

// A node may be disabled by an input that its nodedef need not name (Specification,
// "Standard Node Inputs").
std::optional<Resolver::Key> Resolver::start_output(Frame& frame, const Instance& instance) {
  const Element* disable = instances_.input(instance, "disable");
  if (disable == nullptr || disable->attribute("type") != "boolean") {
    return start_enabled_output(frame, instance);
  }
  frame.stage = Stage::switched;
  return Key{Kind::port, 0, disable, instance.context};
}

std::optional<Resolver::Key> Resolver::start_enabled_output(Frame& frame,
                                                            const Instance& instance) {
  const NodeDef& def = *instance.def;
  const NodeDefOutput& output = def.outputs[frame.key.index];
  const Element* graph = implementations_.graph_of(def);
  implementations_.say_unused(def);
  if (implementations_.is_native(def)) {
    frame.stage = Stage::received;
    return Key{Kind::node, 0, &instance, nullptr};
  }
  frame.stage = Stage::converted;
  if (graph != nullptr) {
    const Element* port = graph->child(output.member.port);
    const Context* context = instances_.functional(instance, *graph);
    if (context != nullptr && port != nullptr && port->category() == "output") {
      return Key{Kind::port, output.member.leaf, port, context};
    }
    if (context != nullptr) {
      complaints_.error(
          "missing-output", *graph,
          fmt::format("the graph lacks an output of the nodedef '{}' that it implements", def.name),
          fmt::format("output '{}'", output.name));
    }
    frame.result.failed = true;
    return std::nullopt;
  }
  // Passing its input through is all that `dot` does.
  if (def.category != "dot") {
    complaints_.warning("no-implementation", *instance.origin,
                        fmt::format("nothing implements '{}': its default is used", def.name));
  }
  return pass_through(frame, instance);
}

// What stands for an output of a node that is disabled, or that nothing implements.
std::optional<Resolver::Key> Resolver::pass_through(Frame& frame, const Instance& instance) {
  const NodeDef& def = *instance.def;
  const NodeDefOutput& output = def.outputs[frame.key.index];
  frame.stage = Stage::converted;
  for (std::uint32_t i = 0; i < def.inputs.size(); ++i) {
    if (!output.defaultinput.empty() && def.inputs[i].name == output.defaultinput) {
      return Key{Kind::input, i, &instance, nullptr};
    }
  }
  if (!output.default_geomprop.empty()) {
    if (const Instance* geomprop =
            instances_.of_geomprop(output.default_geomprop, *instance.origin)) {
      return output_of(*geomprop);
    }
    frame.result.failed = true;
    return std::nullopt;
  }
  frame.result.type = output.type;
  frame.result.source.value = output.default_value;
  frame.result.source.kind = is_numeric(output.type) || is_text(output.type)
                                 ? Source::Kind::literal
                                 : Source::Kind::unconnected;
  return std::nullopt;
}

// A texture node says in which space and unit its file is; what comes out is
// converted here.
std::optional<Resolver::Key> Resolver::finish_native_output(Frame& frame,
                                                            const Instance& instance) {
  const Resolved& node = waited(frame);
  if (node.failed) {
    frame.result.failed = true;
    return std::nullopt;
  }
  frame.result.type = instance.def->outputs[frame.key.index].type;
  frame.result.source = node.source;
  frame.result.source.output = frame.key.index;
  for (std::uint32_t i = 0; i < instance.def->inputs.size(); ++i) {
    const NodeDefInput& input = instance.def->inputs[i];
    if (input.type != Type::filename) continue;
    return convert_texels(frame, instance, slots_.at({Kind::input, i, &instance, nullptr}).result);
  }
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::convert_texels(Frame& frame, const Instance& instance,
                                                      const Resolved& file) {
  frame.stage = Stage::converted;
  const Type type = frame.result.type;
  // Complaints are about who names the file, unless that is a library.
  const bool is_ours = file.carrier != nullptr && &file.carrier->document() == &document_;
  const Element& user = is_ours ? *file.carrier : *instance.origin;
  if (type == Type::color3 || type == Type::color4) {
    return convert_colour(frame.result.source, type, file.source.colorspace, instance.path, user);
  }
  const bool scales = type == Type::float_ || type == Type::vector2 || type == Type::vector3 ||
                      type == Type::vector4;
  if (!scales || file.unit.empty()) return std::nullopt;
  const auto factor = unit_factor(file.unit, nullptr, *instance.origin);
  frame.result.failed = !factor;
  if (!factor || *factor == 1) return std::nullopt;
  return scale(frame.result.source, type, *factor, instance.path, *instance.origin);
}

void Resolver::add_source(const NodeDef& def) {
  if (!with_source_.insert(def.name).second) return;
  graph_.sources.push_back(implementations_.source_of(def));
}

}  // namespace nacre
