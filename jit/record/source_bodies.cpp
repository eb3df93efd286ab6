#include "jit/record/source_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "jit/record/sample_table.h"
#include "jit/record/source_ports.h"
#include "nodes/texture2d/sampler.h"

namespace nacre {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_file_bytes = std::uintmax_t{4} << 20;

bool is_below(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path inner = fs::weakly_canonical(path, error);
  const fs::path outer = fs::weakly_canonical(folder.empty() ? "." : folder, error);
  const auto [end, ignored] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return end == outer.end();
}

std::optional<std::string> read_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > max_file_bytes) {
    return std::nullopt;
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// Looks for `name` in the folders, in order, and reads it; only below `allowed`.
std::optional<glsl::Sources::File> find_source(const std::string& name,
                                               const std::vector<fs::path>& folders,
                                               const std::vector<fs::path>& allowed) {
  for (const fs::path& folder : folders) {
    const fs::path path = (folder / name).lexically_normal();
    const bool may_read = std::any_of(allowed.begin(), allowed.end(),
                                      [&](const fs::path& root) { return is_below(path, root); });
    if (!may_read) continue;
    if (std::optional<std::string> text = read_file(path)) {
      return glsl::Sources::File{path.string(), std::move(*text)};
    }
  }
  return std::nullopt;
}

/// "{{in1}}" as the name "__in1__", of one length, so that columns stay right.
std::string with_names(std::string text) {
  for (std::size_t at = text.find("{{"); at != std::string::npos; at = text.find("{{", at)) {
    const std::size_t end = text.find("}}", at);
    if (end == std::string::npos) break;
    text.replace(at, 2, "__");
    text.replace(end, 2, "__");
  }
  return text;
}

/// Reads the tables that come with a text.
class Tables {
 public:
  Tables(const NodeSource& source, Recorder& recorder) : source_(source), recorder_(recorder) {}

  std::optional<glsl::Value> read(const glsl::Value& sampler, const glsl::Value& place) {
    const auto table = std::find_if(source_.tables.begin(), source_.tables.end(),
                                    [&](const SourceTable& t) { return t.name == sampler.text; });
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
  const NodeSource& source_;
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

glsl::TextureLookup texture_lookup(const NodeSource& source, NodeCall& call) {
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
void say_once(const NodeSource& source, const Diagnostics& found, Diagnostics& diagnostics) {
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

bool misfit(const NodeSource& source, Diagnostics& diagnostics, std::string message,
            std::string expected, std::string found) {
  diagnostics.error("source-misfit", source.where, std::move(message), std::move(expected),
                    std::move(found));
  return false;
}

/// Sets what an output stands for: itself, or the leaves of its structure.
void set_output(NodeCall& call, const SourcePorts::Port& output, const glsl::Value& value) {
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
bool set_only_output(const NodeSource& source, NodeCall& call, const SourcePorts& outputs,
                     std::string message, const glsl::Value& value, Diagnostics& diagnostics) {
  const SourcePorts::Port& output = outputs.all().front();
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

bool record_expression(const NodeSource& source, const glsl::Module& module, NodeCall& call,
                       const glsl::RecordLimits& limits, Diagnostics& diagnostics) {
  const SourcePorts inputs(source, call.inputs());
  std::deque<std::string> names;
  std::vector<std::pair<std::string_view, glsl::Value>> values;
  for (const SourcePorts::Port& input : inputs.all()) {
    values.emplace_back(names.emplace_back(fmt::format("__{}__", input.name)), input.value);
  }
  auto result = module.record_expression(values, call.recorder(), diagnostics, limits);
  if (!result) return false;
  const SourcePorts outputs(source, call.outputs());
  const glsl::Type& wanted = outputs.all().front().value.type;
  if (glsl::converts(result->type, wanted)) result = glsl::convert(*result, wanted);
  return set_only_output(source, call, outputs, "the expression has another type than the output",
                         *result, diagnostics);
}

/// The value as the parameter's type, or nothing, with a diagnostic.
std::optional<glsl::Value> fitted(const NodeSource& source, Diagnostics& diagnostics,
                                  const glsl::Function::Parameter& parameter, std::size_t number,
                                  const SourcePorts::Port& port, bool is_input) {
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
bool record_function(const NodeSource& source, const glsl::Module& module, NodeCall& call,
                     const glsl::RecordLimits& limits, Diagnostics& diagnostics) {
  const glsl::Function* function = module.function(source.function);
  if (function == nullptr) {
    return misfit(source, diagnostics, "the text does not define the function",
                  "'" + source.function + "'", "no such function");
  }
  const SourcePorts inputs(source, call.inputs());
  const SourcePorts outputs(source, call.outputs());
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
    const SourcePorts::Port& port = is_input ? inputs.all()[i] : outputs.all()[i - count];
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

SourceBodies::SourceBodies(std::vector<fs::path> roots)
    : roots_(std::move(roots)), prelude_(glsl::Prelude::read()) {}

bool SourceBodies::record(const NodeSource& source, NodeCall& call, const Stop& stop) {
  Diagnostics found;
  const glsl::RecordLimits limits{.stop = stop};
  const std::shared_ptr<const glsl::Module> module = module_of(source, found, stop);
  const bool done =
      module != nullptr &&
      (source.function.empty() ? record_expression(source, *module, call, limits, found)
                               : record_function(source, *module, call, limits, found));
  say_once(source, found, call.diagnostics());
  return done;
}

bool SourceBodies::check(const NodeSource& source, const NodeDef& def, Diagnostics& diagnostics,
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

std::shared_ptr<const glsl::Module> SourceBodies::module_of(const NodeSource& source,
                                                            Diagnostics& diagnostics,
                                                            const Stop& stop) {
  const std::string key = source.document + '\n' + source.file + '\n' + source.text;
  const std::lock_guard lock(mutex_);
  const auto found = modules_.find(key);
  if (found != modules_.end()) return found->second;
  std::shared_ptr<const glsl::Module> module = read(source, diagnostics, stop);
  // A faulty text is read again, to complain again.
  if (module != nullptr) modules_.emplace(key, module);
  return module;
}

std::shared_ptr<const glsl::Module> SourceBodies::read(const NodeSource& source,
                                                       Diagnostics& diagnostics, const Stop& stop) {
  const fs::path home = fs::path(source.document).parent_path();
  std::vector<fs::path> allowed{home};
  allowed.insert(allowed.end(), roots_.begin(), roots_.end());
  glsl::PreprocessOptions options;
  options.stop = stop;
  options.find_include = [&](const std::string& name, const std::string& from) {
    std::vector<fs::path> folders{fs::path(from).parent_path()};
    folders.insert(folders.end(), allowed.begin(), allowed.end());
    return find_source(name, folders, allowed);
  };
  const std::string& where = source.where.file;
  const int line = source.where.line;
  if (source.file.empty()) {
    if (source.function.empty()) {
      return glsl::Module::read_expression(prelude_, {where, with_names(source.text), line},
                                           diagnostics, stop);
    }
    return glsl::Module::read(prelude_, {where, source.text, line}, options, diagnostics);
  }
  if (source.function.empty()) {
    misfit(source, diagnostics, "the implementation names a file but no function",
           "an attribute 'function'", "none");
    return nullptr;
  }
  std::optional<glsl::Sources::File> file = find_source(source.file, allowed, allowed);
  if (!file) {
    diagnostics.error("missing-source", source.where,
                      "the file of the implementation was not found",
                      "a file below the document's folder or a library's", source.file);
    return nullptr;
  }
  return glsl::Module::read(prelude_, std::move(*file), options, diagnostics);
}

}  // namespace nacre
