#include "jit/record/record.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "jit/record/branches.h"
#include "jit/record/leaves.h"
#include "jit/record/text_bodies.h"
#include "runtime/program/origin.h"
#include "runtime/report_stop.h"

namespace nacre {

namespace {

BranchPlan all_at_once(const Graph& graph) {
  BranchPlan plan;
  plan.branches.resize(1);
  plan.of_node.resize(graph.nodes.size());
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) plan.branches[0].nodes.push_back(i);
  return plan;
}

class GraphRecorder {
 public:
  GraphRecorder(const Graph& graph, const Bodies& bodies, const RecordOptions& options,
                Recorder& recorder, Diagnostics& diagnostics)
      : graph_(graph),
        bodies_(bodies),
        options_(options),
        recorder_(recorder),
        diagnostics_(diagnostics),
        plan_(options.lazy ? plan_branches(graph) : all_at_once(graph)) {
    if (options.texts == nullptr) return;
    for (const NodeText& source : graph.texts) sources_.emplace(source.nodedef, &source);
  }

  std::optional<std::vector<Recorded>> run() {
    outputs_.resize(graph_.nodes.size());
    if (!record_branch(BranchPlan::whole)) return std::nullopt;
    std::vector<Recorded> results;
    for (const GraphOutput& output : graph_.outputs) {
      results.push_back(value_of(output.source, output.type));
    }
    return results;
  }

 private:
  using Ports = std::vector<NodeCall::Port>;

  /// What a pass takes of what was recorded so far, every loop counted for one round.
  double count_steps() {
    const std::vector<Function>& functions = recorder_.program().functions;
    for (std::size_t i = std::max<std::size_t>(1, once_.size()); i < functions.size(); ++i) {
      once_.resize(i);
      once_.push_back(cost_once(functions[i], 0, once_));
    }
    steps_ += cost_once(functions.front(), counted_, once_);
    counted_ = functions.front().code.size();
    return steps_;
  }

  /// All nodes of one branch, in order. False, with a diagnostic, where one cannot
  /// be recorded.
  bool record_branch(std::uint32_t branch) {
    for (const std::uint32_t number : plan_.branches[branch].nodes) {
      const GraphNode& node = graph_.nodes[number];
      if (report_if_due(options_.stop, "recording the graph", node.where, diagnostics_)) {
        return false;
      }
      if (!record_node(number)) return false;
      if (recorder_.size() > options_.max_instructions) {
        diagnostics_.error(
            "program-too-large", node.where, "the graph leads to too large a kernel",
            std::to_string(options_.max_instructions).append(" instructions at most"));
        return false;
      }
      if (count_steps() > static_cast<double>(options_.max_steps)) {
        diagnostics_.error("too-many-steps", node.where,
                           "the graph up to this node takes too long for each point",
                           std::to_string(options_.max_steps).append(" steps at most"));
        return false;
      }
    }
    return true;
  }

  bool record_node(std::uint32_t number) {
    const GraphNode& node = graph_.nodes[number];
    const ScopedOrigin origin(recorder_, node.path);
    const NodeText* source = text_of(node);
    const Bodies::Binding* bound = source == nullptr ? bodies_.binding(node.nodedef) : nullptr;
    const NodeBody* body = bound == nullptr ? nullptr : bound->body;
    if (source == nullptr && body == nullptr) {
      diagnostics_.error("no-implementation", node.where,
                         "nothing implements node '" + node.category + "'",
                         "a nodedef with a body, a node graph or a text", node.nodedef);
      return false;
    }
    if (bound != nullptr && !check_ports(node, *bound->def)) return false;
    const auto [first, second] = plan_.of_node[number];
    if (first != BranchPlan::whole) {
      // A host's body is not known to choose.
      if (body != nullptr && !bound->is_of_host) return record_choice(number, *body);
      if (!record_branch(first) || !record_branch(second)) return false;
    }
    Ports inputs;
    for (const GraphInput& input : node.inputs) {
      inputs.push_back({input.name, value_of(input.source, input.type)});
    }
    Ports outputs;
    for (const GraphNodeOutput& output : node.outputs) {
      outputs.push_back(unset(output.name, output.type));
    }
    if (body != nullptr) {
      outputs_[number] = record(node, *body, std::move(inputs), std::move(outputs));
      return check_outputs(node, outputs_[number]);
    }
    NodeCall call = make_call(node, std::move(inputs), std::move(outputs));
    if (!options_.texts->record(*source, call, options_.stop, options_.holds_lobes)) return false;
    outputs_[number] = call.outputs();
    return true;
  }

  const NodeText* text_of(const GraphNode& node) const {
    const auto found = sources_.find(node.nodedef);
    return found == sources_.end() ? nullptr : found->second;
  }

  /// A body is made for the ports that the library declares, and reads them by name; a
  /// Graph may come from anywhere.
  bool check_ports(const GraphNode& node, const NodeDef& def) {
    bool fits = node.outputs.size() == def.outputs.size();
    for (const NodeDefInput& declared : def.inputs) {
      const GraphInput* input = node.input(declared.name);
      fits = fits && input != nullptr && input->type == declared.type;
    }
    for (std::size_t i = 0; fits && i < def.outputs.size(); ++i) {
      fits = node.outputs[i].name == def.outputs[i].name &&
             node.outputs[i].type == def.outputs[i].type;
    }
    if (fits) return true;
    diagnostics_.error("port-mismatch", node.where,
                       "the ports of this node are not those of the nodedef that it names",
                       "inputs and outputs as the library declares them", node.nodedef);
    return false;
  }

  /// What readers of the node count on.
  bool check_outputs(const GraphNode& node, const Ports& outputs) {
    if (misfit_) return false;
    for (const NodeCall::Port& output : outputs) {
      const Type type = output.value.type;
      if (!is_numeric(type)) continue;
      const Scalar scalar = scalar_of(type);
      const bool fits =
          output.value.parts.size() == static_cast<std::size_t>(component_count(type)) &&
          std::all_of(output.value.parts.begin(), output.value.parts.end(), [&](Ref part) {
            const bool is_ours = part.is_constant() || part.recorder == &recorder_;
            return is_ours && part.type == scalar;
          });
      if (fits) continue;
      diagnostics_.error("port-mismatch", node.where,
                         "the body of '" + node.nodedef + "' does not set output '" + output.name +
                             "' to a value of its type, recorded in this call",
                         std::string(type_name(type)));
      return false;
    }
    return true;
  }

  /// The condition alone, and then the branches: a side that a constant excludes not at
  /// all, the others where some lane takes them (flatten_regions() undoes the cheap ones). The
  /// result has the bits that selecting between both sides would give.
  bool record_choice(std::uint32_t number, const NodeBody& body) {
    const GraphNode& node = graph_.nodes[number];
    Ports compared;
    for (const char* name : {"value1", "value2"}) {
      const GraphInput* input = node.input(name);
      compared.push_back({input->name, value_of(input->source, input->type)});
    }
    const Ports asked = record(node, body, std::move(compared), {unset("out", Type::boolean)});
    const Bool holds(asked[0].value.parts[0]);
    const auto [first, second] = plan_.of_node[number];
    Recorded& out =
        outputs_[number].emplace_back(unset(node.outputs[0].name, node.outputs[0].type)).value;

    if (holds.is_constant()) {
      const bool taken = holds.is_constant(true);
      if (!record_branch(taken ? first : second)) return false;
      out = side(node, taken ? "in1" : "in2");
      return true;
    }
    std::array<Side, 2> sides{{{holds, first, "in1"}, {!holds, second, "in2"}}};
    // A side without nodes of its own goes first: the region of the other can give its value.
    if (plan_.branches[second].nodes.empty()) std::swap(sides[0], sides[1]);
    std::optional<Recorded> taken;
    if (plan_.branches[sides[0].branch].nodes.empty()) taken = side(node, sides[0].input);
    const ValueId start = recorder_.next_value();
    if (!taken) taken = record_first(node, sides[0]);
    const auto chosen = taken ? record_second(node, sides[1], *taken, start) : std::nullopt;
    if (chosen) out = *chosen;
    return chosen.has_value();
  }

  /// A side of a choice: its lanes, its nodes, the input that it feeds.
  struct Side {
    Bool mask;
    std::uint32_t branch;
    std::string_view input;
  };

  /// The value of the first side in its lanes; what it is in others nobody asks.
  std::optional<Recorded> record_first(const GraphNode& node, const Side& first) {
    return record_where(node, first, [&](Ref inside, std::size_t) {
      return recorder_.outlives_region(inside) ? inside
                                               : recorder_.merge(inside, {nullptr, 0, inside.type});
    });
  }

  /// The value of the second in its lanes, in others `taken`. Where that was merged, which is
  /// from `start` on, and this value was there before, the merge gives it to all lanes.
  std::optional<Recorded> record_second(const GraphNode& node, const Side& second,
                                        const Recorded& taken, ValueId start) {
    return record_where(node, second, [&](Ref inside, std::size_t i) {
      const Ref merged = taken.parts[i];
      const bool is_merge = !merged.is_constant() && merged.id >= start;
      const bool was_there = !inside.is_constant() && inside.id < start;
      if (!is_merge || !was_there) return recorder_.merge(inside, merged);
      recorder_.set_outer(merged, inside);
      return merged;
    });
  }

  /// Records a side as a region; `leave` gives each part of its value to what comes behind.
  template <class Leave>
  std::optional<Recorded> record_where(const GraphNode& node, const Side& taken, Leave&& leave) {
    recorder_.begin_if(taken.mask.ref());
    std::optional<Recorded> result;
    if (record_branch(taken.branch)) {
      result = side(node, taken.input);
      for (std::size_t i = 0; i < result->parts.size(); ++i) {
        result->parts[i] = leave(result->parts[i], i);
      }
    }
    recorder_.end_if();
    return result;
  }

  Recorded side(const GraphNode& node, std::string_view name) {
    const GraphInput& input = *node.input(name);
    return value_of(input.source, input.type);
  }

  static NodeCall::Port unset(const std::string& name, Type type) {
    NodeCall::Port port{name, {}};
    port.value.type = type;
    return port;
  }

  NodeCall make_call(const GraphNode& node, Ports inputs, Ports outputs) {
    if (options_.before_node) options_.before_node(node);
    NodeCall call(recorder_, node.category, node.nodedef, std::move(inputs), std::move(outputs),
                  options_.accuracy, options_.textures, diagnostics_, node.where);
    call.fade_noise(options_.fade_noise);
    return call;
  }

  Ports record(const GraphNode& node, const NodeBody& body, Ports inputs, Ports outputs) {
    NodeCall call = make_call(node, std::move(inputs), std::move(outputs));
    const auto before = static_cast<std::ptrdiff_t>(diagnostics_.all().size());
    body.record(call);
    // What the body asked for in vain, NodeCall has said.
    misfit_ = std::any_of(diagnostics_.all().begin() + before, diagnostics_.all().end(),
                          [](const Diagnostic& one) { return one.code == "port-mismatch"; });
    return call.outputs();
  }

  Recorded value_of(const Source& source, Type type) {
    switch (source.kind) {
      case Source::Kind::unconnected: break;
      case Source::Kind::link: return outputs_[source.node][source.output].value;
      case Source::Kind::literal: return literal(source, type, options_);
      case Source::Kind::parameter:
        return parameter(graph_.parameters[source.parameter], options_, recorder_);
    }
    Recorded nothing;
    nothing.type = type;
    return nothing;
  }

  const Graph& graph_;
  const Bodies& bodies_;
  const RecordOptions& options_;
  Recorder& recorder_;
  Diagnostics& diagnostics_;
  BranchPlan plan_;
  bool misfit_ = false;  ///< The last body asked for ports that are not there.
  std::unordered_map<std::string_view, const NodeText*> sources_;  ///< By nodedef.
  std::vector<Ports> outputs_;                                     ///< By node.
  std::vector<double> once_;  ///< By function: steps, each loop counted for one round.
  std::size_t counted_ = 0;   ///< Of the entry's instructions.
  double steps_ = 0;
};

}  // namespace

std::optional<std::vector<Recorded>> record_graph(const Graph& graph, const Bodies& bodies,
                                                  const RecordOptions& options, Recorder& recorder,
                                                  Diagnostics& diagnostics) {
  return GraphRecorder(graph, bodies, options, recorder, diagnostics).run();
}

}  // namespace nacre
