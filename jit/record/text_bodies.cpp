#include "jit/record/text_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "jit/record/sample_table.h"
#include "jit/record/text_fit.h"
#include "jit/record/text_lobe.h"
#include "jit/record/text_ports.h"
#include "nodes/texture2d/sampler.h"

namespace nacre {

namespace {

/// Reads the tables that come with a text.
class Tables {
 public:
  Tables(const NodeText& source, Recorder& recorder) : source_(source), recorder_(recorder) {}

  std::optional<glsl::Value> read(const glsl::Value& sampler, const glsl::Value& place) {
    const auto table = std::find_if(source_.tables.begin(), source_.tables.end(),
                                    [&](const TextTable& t) { return t.name == sampler.text; });
    if (table == source_.tables.end() || !is_whole(*table)) return std::nullopt;
    const auto [known, is_new] = added_.try_emplace(table->name, 0);
    if (is_new) known->second = add_table(recorder_, *table);
    std::vector<Float> coordinates;
    for (std::size_t i = 0; i < place.parts.size(); ++i) coordinates.push_back(place.number(i));
    glsl::Value result{glsl::float_type.with_rows(4), {}, {}};
    for (const Float& part : sample_table(recorder_, *table, known->second, coordinates)) {
      result.parts.push_back(part.ref());
    }
    return result;
  }

 private:
  const NodeText& source_;
  Recorder& recorder_;
  std::map<std::string, std::uint32_t> added_;
};

std::optional<glsl::Value> read_image(NodeCall& call, const std::string& image,
                                      const glsl::Value& uv) {
  const ImageLookup lookup{.uv = {uv.number(0), uv.number(1)}};
  const TextureSources images =
      call.textures() == nullptr ? TextureSources{} : call.textures()->find(image, "");
  const Float4 texel = sample_images(call.recorder(), images, lookup);
  return glsl::Value{glsl::float_type.with_rows(4),
                     {texel.x.ref(), texel.y.ref(), texel.z.ref(), texel.w.ref()},
                     {}};
}

glsl::TextureLookup texture_lookup(const NodeText& source, NodeCall& call) {
  const auto tables = std::make_shared<Tables>(source, call.recorder());
  return [&call, tables](const glsl::Value& sampler, const glsl::Value& place,
                         const glsl::Value* ddx, const glsl::Value*) -> std::optional<glsl::Value> {
    if (sampler.is_uniform) return tables->read(sampler, place);
    // Footprints are derived from uv itself; others cannot be given.
    if (ddx != nullptr || place.parts.size() != 2) return std::nullopt;
    return read_image(call, sampler.text, place);
  };
}

/// Sets what an output stands for: itself, or the leaves of its structure.
void set_output(NodeCall& call, const TextPorts::Port& output, const glsl::Value& value) {
  auto part = value.parts.begin();
  for (std::size_t i = output.first; i < output.first + output.count; ++i) {
    const NodeCall::Port& leaf = call.outputs()[i];
    const auto end = part + glsl::part_count(glsl_type(leaf.value.type));
    call.set(leaf.name, std::vector<Ref>(part, end));
    part = end;
  }
}

/// Sets the node's only output to the value of an expression, or of a function that
/// returns it.
bool set_only_output(const NodeText& source, NodeCall& call, const TextPorts& outputs,
                     std::string message, const glsl::Value& value, Diagnostics& diagnostics) {
  const TextPorts::Port& output = outputs.all().front();
  if (outputs.all().size() != 1) {
    return misfit(source.where, diagnostics, std::move(message), "one output",
                  fmt::format("{} outputs", outputs.all().size()));
  }
  if (const auto difference = find_misfit(output.value.type, value.type)) {
    return misfit(source.where, diagnostics, std::move(message), difference->expected,
                  difference->found);
  }
  set_output(call, output, value);
  return true;
}

bool record_expression(const NodeText& source, const glsl::Module& module, NodeCall& call,
                       const glsl::RecordLimits& limits, Diagnostics& diagnostics) {
  const TextPorts inputs(source, call.inputs());
  std::deque<std::string> names;
  std::vector<std::pair<std::string_view, glsl::Value>> values;
  for (const TextPorts::Port& input : inputs.all()) {
    values.emplace_back(names.emplace_back(fmt::format("__{}__", input.name)), input.value);
  }
  auto result = module.record_expression(values, call.recorder(), diagnostics, limits);
  if (!result) return false;
  const TextPorts outputs(source, call.outputs());
  const glsl::Type& wanted = outputs.all().front().value.type;
  if (glsl::converts(result->type, wanted)) result = glsl::convert(*result, wanted);
  return set_only_output(source, call, outputs, "the expression has another type than the output",
                         *result, diagnostics);
}

/// A function may also return its only output.
bool record_function(const NodeText& source, const glsl::Module& module, NodeCall& call,
                     const glsl::RecordLimits& limits, Diagnostics& diagnostics) {
  const glsl::Function* function = module.function(source.function);
  if (function == nullptr) {
    return misfit(source.where, diagnostics, "the text does not define the function",
                  "'" + source.function + "'", "no such function");
  }
  const TextPorts inputs(source, call.inputs());
  const TextPorts outputs(source, call.outputs());
  const bool returns = !function->type.is_void();
  const std::size_t count = inputs.all().size();
  const std::size_t wanted = count + (returns ? 0 : outputs.all().size());
  if (function->parameters.size() != wanted) {
    return misfit(
        source.where, diagnostics,
        "function '" + source.function + "' must take the node's inputs, then its outputs",
        fmt::format("{} parameters", wanted), fmt::format("{}", function->parameters.size()));
  }
  std::vector<glsl::Value> arguments;
  for (std::size_t i = 0; i < wanted; ++i) {
    const bool is_input = i < count;
    const TextPorts::Port& port = is_input ? inputs.all()[i] : outputs.all()[i - count];
    auto argument = fitted({source.function, function->parameters[i], i + 1, port, is_input},
                           source.where, diagnostics);
    if (!argument) return false;
    arguments.push_back(std::move(*argument));
  }
  const auto result = module.record(*function, std::move(arguments), call.recorder(), diagnostics,
                                    texture_lookup(source, call), limits);
  if (!result) return false;
  if (returns) {
    return set_only_output(source, call, outputs,
                           "the function returns another type than the output", result->value,
                           diagnostics);
  }
  for (std::size_t i = 0; i < outputs.all().size(); ++i) {
    set_output(call, outputs.all()[i], result->outputs[count + i]);
  }
  return true;
}

bool makes_lobe(const NodeCall& call) {
  return !call.outputs().empty() && call.out_type() == Type::bsdf;
}

}  // namespace

bool TextBodies::record(const NodeText& source, NodeCall& call, const Stop& stop,
                        bool holds_lobes) {
  Diagnostics found;
  const glsl::RecordLimits limits{.stop = stop};
  const std::shared_ptr<const glsl::Module> module = modules_.find(source, found, stop);
  bool done = false;
  if (module == nullptr) {
    // Was said.
  } else if (makes_lobe(call)) {
    done = set_text_lobe(source, module, call, {limits, holds_lobes}, found);
  } else if (source.function.empty()) {
    done = record_expression(source, *module, call, limits, found);
  } else {
    done = record_function(source, *module, call, limits, found);
  }
  say_once(source.where.path, found, call.diagnostics());
  return done;
}

bool TextBodies::check(const NodeText& source, const NodeDef& def, Diagnostics& diagnostics,
                       const Stop& stop) {
  Recorder recorder;
  std::vector<NodeCall::Port> inputs;
  for (const NodeDefInput& input : def.inputs) {
    NodeCall::Port port{std::string(input.name), {}};
    port.value.type = input.type;
    const Scalar scalar = input.type == Type::integer   ? Scalar::i32
                          : input.type == Type::boolean ? Scalar::b1
                                                        : Scalar::f32;
    for (int i = 0; i < component_count(input.type); ++i) {
      port.value.parts.push_back(recorder.input(fmt::format("{}.{}", port.name, i), scalar));
    }
    inputs.push_back(std::move(port));
  }
  std::vector<NodeCall::Port> outputs;
  for (const NodeDefOutput& output : def.outputs) {
    outputs.push_back({std::string(output.name), {}});
    outputs.back().value.type = output.type;
  }
  NodeCall call(recorder, def.category, def.name, std::move(inputs), std::move(outputs),
                Accuracy::standard, nullptr, diagnostics, source.where);
  return record(source, call, stop) && (!makes_lobe(call) || try_text_lobe(recorder, call));
}

}  // namespace nacre
