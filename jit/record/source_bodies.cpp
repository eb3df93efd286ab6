#include "jit/record/source_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "jit/record/sample_table.h"
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

// -- Values of ports

glsl::Type glsl_type(Type type) {
  const auto vector = [](int rows) { return glsl::float_type.with_rows(rows); };
  switch (type) {
    case Type::boolean: return glsl::bool_type;
    case Type::integer: return glsl::int_type;
    case Type::float_: return glsl::float_type;
    case Type::vector2: return vector(2);
    case Type::color3:
    case Type::vector3: return vector(3);
    case Type::color4:
    case Type::vector4: return vector(4);
    case Type::matrix33: return {glsl::Base::number, 3, 3};
    case Type::matrix44: return {glsl::Base::number, 4, 4};
    case Type::filename: return {glsl::Base::sampler, 2};
    case Type::string:
    case Type::geomname: return glsl::int_type;
    default: return glsl::void_type;
  }
}

int enum_index(const NodeSource& source, std::string_view input, const std::string& text) {
  for (const auto& [name, values] : source.enums) {
    const auto found = std::find(values.begin(), values.end(), text);
    if (name == input && found != values.end()) return static_cast<int>(found - values.begin());
  }
  return 0;
}

glsl::Value argument(const NodeSource& source, const NodeCall::Port& port) {
  glsl::Value value{glsl_type(port.value.type), port.value.parts, {}};
  if (port.value.type == Type::filename) {
    value.text = port.value.text;
  } else if (is_text(port.value.type)) {
    value.parts = {Ref::literal(enum_index(source, port.name, port.value.text))};
  }
  return value;
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

std::string type_text(Type type) { return std::string(type_name(type)); }

bool misfit(const NodeSource& source, Diagnostics& diagnostics, std::string message,
            std::string expected, std::string found) {
  diagnostics.error("source-misfit", source.where, std::move(message), std::move(expected),
                    std::move(found));
  return false;
}

/// The inputs of a node under their names. What came apart as "in.a", "in.b.c" is
/// one structure again; the types live as long as this.
class Arguments {
 public:
  Arguments(const NodeSource& source, const NodeCall& call) {
    Members members;
    for (const NodeCall::Port& port : call.inputs()) {
      members.emplace_back(port.name, argument(source, port));
    }
    for (std::size_t i = 0; i < members.size();) {
      const std::string head = members[i].first.substr(0, members[i].first.find('.'));
      const std::size_t first = i++;
      while (i < members.size() && members[i].first.starts_with(head + '.')) ++i;
      const bool is_whole = members[first].first == head;
      const std::string& name = names_.emplace_back(fmt::format("__{}__", head));
      values_.emplace_back(name, is_whole ? members[first].second
                                          : structure_of(members, first, i, head.size() + 1));
    }
  }

  const std::vector<std::pair<std::string_view, glsl::Value>>& values() const { return values_; }

 private:
  using Members = std::vector<std::pair<std::string, glsl::Value>>;

  /// Members [first, end), whose paths agree in their first `skip` letters.
  glsl::Value structure_of(const Members& members, std::size_t first, std::size_t end,
                           std::size_t skip) {
    glsl::Struct& made = types_.emplace_back();
    glsl::Value result{{glsl::Base::structure}, {}, {}};
    result.type.structure = &made;
    while (first < end) {
      const std::string& path = members[first].first;
      const std::size_t dot = path.find('.', skip);
      std::size_t next = first + 1;
      glsl::Value value = members[first].second;
      if (dot != std::string::npos) {
        while (next < end && members[next].first.starts_with(path.substr(0, dot + 1))) ++next;
        value = structure_of(members, first, next, dot + 1);
      }
      const std::string& name = names_.emplace_back(path.substr(skip, dot - skip));
      made.members.push_back({name, value.type});
      result.parts.insert(result.parts.end(), value.parts.begin(), value.parts.end());
      first = next;
    }
    return result;
  }

  std::deque<glsl::Struct> types_;
  std::deque<std::string> names_;
  std::vector<std::pair<std::string_view, glsl::Value>> values_;
};

bool record_expression(const NodeSource& source, const glsl::Module& module, NodeCall& call) {
  const Arguments arguments(source, call);
  const auto& values = arguments.values();
  const auto result = module.record_expression(values, call.recorder(), call.diagnostics());
  if (!result) return false;
  const glsl::Type wanted = glsl_type(call.out_type());
  if (!glsl::converts(result->type, wanted)) {
    return misfit(source, call.diagnostics(), "the expression has another type than the output",
                  to_string(wanted) + " for " + type_text(call.out_type()),
                  to_string(result->type));
  }
  call.set(glsl::convert(*result, wanted).parts);
  return true;
}

/// A function may also return its only output.
bool record_function(const NodeSource& source, const glsl::Module& module, NodeCall& call) {
  const glsl::Function* function = module.function(source.function);
  if (function == nullptr) {
    return misfit(source, call.diagnostics(), "the text does not define the function",
                  "'" + source.function + "'", "no such function");
  }
  const bool returns = !function->type.is_void();
  const std::size_t inputs = call.inputs().size();
  const std::size_t wanted = inputs + (returns ? 0 : call.outputs().size());
  if (function->parameters.size() != wanted) {
    return misfit(
        source, call.diagnostics(),
        "function '" + source.function + "' must take the node's inputs, then its outputs",
        fmt::format("{} parameters", wanted), fmt::format("{}", function->parameters.size()));
  }
  std::vector<glsl::Value> arguments;
  for (std::size_t i = 0; i < wanted; ++i) {
    const bool is_input = i < inputs;
    const NodeCall::Port& port = is_input ? call.inputs()[i] : call.outputs()[i - inputs];
    const glsl::Function::Parameter& parameter = function->parameters[i];
    const glsl::Type type = glsl_type(port.value.type);
    const bool fits = is_input ? parameter.in && glsl::converts(type, parameter.type)
                               : parameter.out && parameter.type == type;
    if (!fits) {
      return misfit(source, call.diagnostics(),
                    fmt::format("parameter {} of function '{}' does not fit {} '{}'", i + 1,
                                source.function, is_input ? "input" : "output", port.name),
                    (is_input ? "" : "out ") + to_string(type),
                    (parameter.out ? "out " : "") + to_string(parameter.type));
    }
    arguments.push_back(is_input ? glsl::convert(argument(source, port), parameter.type)
                                 : glsl::zero(type));
  }
  const auto result = module.record(*function, std::move(arguments), call.recorder(),
                                    call.diagnostics(), texture_lookup(source, call));
  if (!result) return false;
  if (returns) {
    const glsl::Type type = glsl_type(call.out_type());
    if (result->value.type != type || call.outputs().size() != 1) {
      return misfit(source, call.diagnostics(), "the function returns another type than the output",
                    to_string(type), to_string(result->value.type));
    }
    call.set(result->value.parts);
    return true;
  }
  for (std::size_t i = 0; i < call.outputs().size(); ++i) {
    call.set(call.outputs()[i].name, result->outputs[inputs + i].parts);
  }
  return true;
}

}  // namespace

bool SourceBodies::record(const NodeSource& source, NodeCall& call) {
  const std::shared_ptr<const glsl::Module> module = module_of(source, call.diagnostics());
  if (module == nullptr) return false;
  return source.function.empty() ? record_expression(source, *module, call)
                                 : record_function(source, *module, call);
}

bool SourceBodies::check(const NodeSource& source, const NodeDef& def, Diagnostics& diagnostics) {
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
  return record(source, call);
}

std::shared_ptr<const glsl::Module> SourceBodies::module_of(const NodeSource& source,
                                                            Diagnostics& diagnostics) {
  const std::string key = source.document + '\n' + source.file + '\n' + source.text;
  const std::lock_guard lock(mutex_);
  const auto found = modules_.find(key);
  if (found != modules_.end()) return found->second;
  std::shared_ptr<const glsl::Module> module = read(source, diagnostics);
  // A faulty text is read again, to complain again.
  if (module != nullptr) modules_.emplace(key, module);
  return module;
}

std::shared_ptr<const glsl::Module> SourceBodies::read(const NodeSource& source,
                                                       Diagnostics& diagnostics) {
  const fs::path home = fs::path(source.document).parent_path();
  std::vector<fs::path> allowed{home};
  allowed.insert(allowed.end(), roots_.begin(), roots_.end());
  glsl::PreprocessOptions options;
  options.find_include = [&](const std::string& name, const std::string& from) {
    std::vector<fs::path> folders{fs::path(from).parent_path()};
    folders.insert(folders.end(), allowed.begin(), allowed.end());
    return find_source(name, folders, allowed);
  };
  const std::string& where = source.where.file;
  const int line = source.where.line;
  if (source.file.empty()) {
    if (source.function.empty()) {
      return glsl::Module::read_expression({where, with_names(source.text), line}, diagnostics);
    }
    return glsl::Module::read({where, source.text, line}, options, diagnostics);
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
  return glsl::Module::read(std::move(*file), options, diagnostics);
}

}  // namespace nacre
