#include "jit/record/text_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "jit/record/sample_table.h"
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

/// Hands on what was found about a text: with the path of the implementation that it is of,
/// where none is given, and not what was said before, of another node of that kind.
void say_once(const NodeText& source, const Diagnostics& found, Diagnostics& diagnostics) {
  for (Diagnostic one : found.all()) {
    if (one.where.path.empty()) one.where.path = source.where.path;
    const auto is_same = [&](const Diagnostic& other) {
      return other.where.line == one.where.line && other.where.column == one.where.column &&
             other.code == one.code && other.where.file == one.where.file &&
             other.where.path == one.where.path && other.message == one.message;
    };
    const std::vector<Diagnostic>& said = diagnostics.all();
    if (std::none_of(said.begin(), said.end(), is_same)) diagnostics.add(std::move(one));
  }
}

bool misfit(const NodeText& source, Diagnostics& diagnostics, std::string message,
            std::string expected, std::string found) {
  diagnostics.error("source-misfit", source.where, std::move(message), std::move(expected),
                    std::move(found));
  return false;
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
    return misfit(source, diagnostics, std::move(message), "one output",
                  fmt::format("{} outputs", outputs.all().size()));
  }
  if (const auto difference = find_misfit(output.value.type, value.type)) {
    return misfit(source, diagnostics, std::move(message), difference->expected, difference->found);
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

/// The value as the parameter's type, or nothing, with a diagnostic.
std::optional<glsl::Value> fitted(const NodeText& source, Diagnostics& diagnostics,
                                  const glsl::Function::Parameter& parameter, std::size_t number,
                                  const TextPorts::Port& port, bool is_input) {
  const bool converts = is_input && glsl::converts(port.value.type, parameter.type);
  if (converts && parameter.in) return glsl::convert(port.value, parameter.type);
  std::optional<SourceMisfit> difference = find_misfit(port.value.type, parameter.type);
  const bool has_direction = is_input ? parameter.in : parameter.out;
  if (!difference && has_direction) {
    return is_input ? glsl::Value{parameter.type, port.value.parts, {}}
                    : glsl::zero(parameter.type);
  }
  if (!difference) {
    difference = {to_string(parameter.type), to_string(parameter.type)};
  }
  misfit(source, diagnostics,
         fmt::format("parameter {} of function '{}' does not fit {} '{}'", number, source.function,
                     is_input ? "input" : "output", port.name),
         (is_input ? "" : "out ") + difference->expected,
         (parameter.out ? "out " : "") + difference->found);
  return std::nullopt;
}

/// A function may also return its only output.
bool record_function(const NodeText& source, const glsl::Module& module, NodeCall& call,
                     const glsl::RecordLimits& limits, Diagnostics& diagnostics) {
  const glsl::Function* function = module.function(source.function);
  if (function == nullptr) {
    return misfit(source, diagnostics, "the text does not define the function",
                  "'" + source.function + "'", "no such function");
  }
  const TextPorts inputs(source, call.inputs());
  const TextPorts outputs(source, call.outputs());
  const bool returns = !function->type.is_void();
  const std::size_t count = inputs.all().size();
  const std::size_t wanted = count + (returns ? 0 : outputs.all().size());
  if (function->parameters.size() != wanted) {
    return misfit(
        source, diagnostics,
        "function '" + source.function + "' must take the node's inputs, then its outputs",
        fmt::format("{} parameters", wanted), fmt::format("{}", function->parameters.size()));
  }
  std::vector<glsl::Value> arguments;
  for (std::size_t i = 0; i < wanted; ++i) {
    const bool is_input = i < count;
    const TextPorts::Port& port = is_input ? inputs.all()[i] : outputs.all()[i - count];
    auto argument = fitted(source, diagnostics, function->parameters[i], i + 1, port, is_input);
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

}  // namespace

bool TextBodies::record(const NodeText& source, NodeCall& call, const Stop& stop) {
  Diagnostics found;
  const glsl::RecordLimits limits{.stop = stop};
  const std::shared_ptr<const glsl::Module> module = modules_.find(source, found, stop);
  const bool done =
      module != nullptr &&
      (source.function.empty() ? record_expression(source, *module, call, limits, found)
                               : record_function(source, *module, call, limits, found));
  say_once(source, found, call.diagnostics());
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
  return record(source, call, stop);
}

}  // namespace nacre
