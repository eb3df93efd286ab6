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

/// Where a person finds what a node is there for: in the document, at what a graph of a library
/// stands for, with the path of the node in it.
SourceLocation place_of(const Instance& instance, const Document& document) {
  const Instance* shown = &instance;
  while (&shown->origin->document() != &document) {
    const Context* context = shown->context;
    while (context != nullptr && context->instance == nullptr) context = context->parent;
    if (context == nullptr) break;
    shown = context->instance;
  }
  SourceLocation where = location(*shown->origin);
  if (shown != &instance) where.path = instance.path;
  return where;
}

}  // namespace

std::optional<Resolver::Key> Resolver::step_node(Task& task) {
  const Instance& instance = *static_cast<const Instance*>(task.key.subject);
  const NodeDef& def = *instance.def;
  if (task.next_input < def.inputs.size()) {
    return Key{Kind::input, task.next_input++, &instance, nullptr};
  }

  GraphNode node;
  node.category = def.category;
  node.nodedef = def.name;
  node.path = instance.path;
  node.where = place_of(instance, document_);
  for (std::uint32_t i = 0; i < def.inputs.size(); ++i) {
    const Resolved& result = slots_.at({Kind::input, i, &instance, nullptr}).result;
    if (result.failed) task.result.failed = true;
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
  if (task.result.failed) return std::nullopt;
  literals_.choose_frame(node, *instance.origin);
  task.result.source.kind = Source::Kind::link;
  task.result.source.node = static_cast<std::uint32_t>(graph_.nodes.size());
  graph_.nodes.push_back(std::move(node));
  if (implementations_.runs_text(def)) add_source(def);
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::step_output(Task& task) {
  const Instance& instance = *static_cast<const Instance*>(task.key.subject);
  switch (task.stage) {
    case Stage::start: return start_output(task, instance);
    case Stage::received: {
      const std::optional<Key> next = finish_native_output(task, instance);
      if (instance.def->outputs.size() == 1) forget_waited(task);
      return next;
    }
    case Stage::switched: {
      Resolved disable = waited(task);
      if (!disable.failed) literals_.make_uniform(disable_input(), *instance.origin, disable);
      task.result.failed = disable.failed;
      if (disable.failed) return std::nullopt;
      const std::vector<std::int32_t>& value = disable.source.value.ints;
      if (value.empty() || value[0] == 0) return start_enabled_output(task, instance);
      return pass_through(task, instance);
    }
    default: {
      const Type type = instance.def->outputs[task.key.index].type;
      task.result = waited(task);
      if (!task.result.failed && task.result.type != type) {
        complaints_.error("type-mismatch", *instance.origin,
                          fmt::format("the graph of '{}' gives another type than its nodedef says",
                                      instance.def->name),
                          std::string(type_name(type)), std::string(type_name(task.result.type)));
        task.result.failed = true;
      }
      return std::nullopt;
    }
  }
}

// A node may be disabled by an input that its nodedef need not name (Specification,
// "Standard Node Inputs").
std::optional<Resolver::Key> Resolver::start_output(Task& task, const Instance& instance) {
  const Element* disable = instances_.input(instance, "disable");
  if (disable == nullptr || disable->attribute("type") != "boolean") {
    return start_enabled_output(task, instance);
  }
  task.stage = Stage::switched;
  return Key{Kind::port, 0, disable, instance.context};
}

std::optional<Resolver::Key> Resolver::start_enabled_output(Task& task, const Instance& instance) {
  const NodeDef& def = *instance.def;
  const NodeDefOutput& output = def.outputs[task.key.index];
  const Element* graph = implementations_.graph_of(def);
  implementations_.say_unused(def);
  if (implementations_.is_native(def)) {
    task.stage = Stage::received;
    return Key{Kind::node, 0, &instance, nullptr};
  }
  task.stage = Stage::converted;
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
    task.result.failed = true;
    return std::nullopt;
  }
  // Passing its input through is all that `dot` does.
  if (def.category != "dot") {
    complaints_.warning("no-implementation", *instance.origin,
                        fmt::format("nothing implements '{}': its default is used", def.name));
  }
  return pass_through(task, instance);
}

// What stands for an output of a node that is disabled, or that nothing implements.
std::optional<Resolver::Key> Resolver::pass_through(Task& task, const Instance& instance) {
  const NodeDef& def = *instance.def;
  const NodeDefOutput& output = def.outputs[task.key.index];
  task.stage = Stage::converted;
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
    task.result.failed = true;
    return std::nullopt;
  }
  task.result.type = output.type;
  task.result.source.value = output.default_value;
  task.result.source.kind = is_numeric(output.type) || is_text(output.type)
                                ? Source::Kind::literal
                                : Source::Kind::unconnected;
  return std::nullopt;
}

// A texture node says in which space and unit its file is; what comes out is
// converted here.
std::optional<Resolver::Key> Resolver::finish_native_output(Task& task, const Instance& instance) {
  const Resolved& node = waited(task);
  if (node.failed) {
    task.result.failed = true;
    return std::nullopt;
  }
  task.result.type = instance.def->outputs[task.key.index].type;
  task.result.source = node.source;
  task.result.source.output = task.key.index;
  for (std::uint32_t i = 0; i < instance.def->inputs.size(); ++i) {
    const NodeDefInput& input = instance.def->inputs[i];
    if (input.type != Type::filename) continue;
    return convert_texels(task, instance, slots_.at({Kind::input, i, &instance, nullptr}).result);
  }
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::convert_texels(Task& task, const Instance& instance,
                                                      const Resolved& file) {
  task.stage = Stage::converted;
  const Type type = task.result.type;
  // Complaints are about who names the file, unless that is a library.
  const bool is_ours = file.carrier != nullptr && &file.carrier->document() == &document_;
  const Element& user = is_ours ? *file.carrier : *instance.origin;
  if (type == Type::color3 || type == Type::color4) {
    return convert_colour(task.result.source, type, file.source.colorspace, instance.path, user);
  }
  const bool scales = type == Type::float_ || type == Type::vector2 || type == Type::vector3 ||
                      type == Type::vector4;
  if (!scales || file.unit.empty()) return std::nullopt;
  const auto factor = unit_factor(file.unit, nullptr, *instance.origin);
  task.result.failed = !factor;
  if (!factor || *factor == 1) return std::nullopt;
  return scale(task.result.source, type, *factor, instance.path, *instance.origin);
}

void Resolver::add_source(const NodeDef& def) {
  if (!with_source_.insert(def.name).second) return;
  graph_.texts.push_back(implementations_.text_of(def));
}

}  // namespace nacre
