#include "jit/record/text_lobe_functions.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "jit/record/text_fit.h"

namespace nacre {

namespace {

const glsl::Type vec2 = glsl::float_type.with_rows(2);
const glsl::Type vec3 = glsl::float_type.with_rows(3);

/// What a function must look like.
struct Signature {
  std::string_view suffix;
  glsl::Type returns;
  std::vector<std::string_view> leading;  ///< What the kernel passes, each a vec3.
  bool is_optional = false;
};

std::string named_type(const glsl::Type& type) {
  if (type.base != glsl::Base::structure) return to_string(type);
  return type.is_array() ? fmt::format("struct[{}]", type.length) : "struct";
}

std::string declaration(const glsl::Function& function) {
  std::string parameters;
  for (const glsl::Function::Parameter& parameter : function.parameters) {
    parameters +=
        fmt::format("{}{}{}{}{}", parameters.empty() ? "" : ", ",
                    parameter.out ? (parameter.in ? "inout " : "out ") : "",
                    named_type(parameter.type), parameter.name.empty() ? "" : " ", parameter.name);
  }
  return fmt::format("{} {}({})", named_type(function.type), function.name, parameters);
}

class FunctionFinder {
 public:
  FunctionFinder(const NodeText& source, const glsl::Module& module, NodeCall& call,
                 Diagnostics& diagnostics)
      : source_(source),
        module_(module),
        diagnostics_(diagnostics),
        ports_(source, of_functions(call)) {
    for (const TextPorts::Port& port : ports_.all()) {
      TextPorts::Port kept = port;
      for (Ref& part : kept.value.parts) part = call.recorder().keep(part);
      inputs_.push_back(std::move(kept));
    }
  }

  /// False, with a diagnostic, for inputs that no text can have.
  bool can_pass_inputs(const NodeCall& call) {
    for (const TextPorts::Port& input : inputs_) {
      if (!input.value.type.is_void()) continue;
      return misfit(source_.where, diagnostics_,
                    fmt::format("a lobe by text cannot have input '{}'", input.name),
                    "a number, a string of an enumeration or a structure",
                    std::string(type_name(call.type(input.name))));
    }
    return true;
  }

  /// Null of a function that is missing but need not be there; nothing, with a diagnostic, for
  /// one that must or that does not fit.
  std::optional<LobeFunction> find(const Signature& signature) {
    const std::string name = fmt::format("{}_{}", source_.function, signature.suffix);
    const glsl::Function* function = module_.function(name);
    if (function == nullptr) {
      if (signature.is_optional) return LobeFunction{};
      misfit(source_.where, diagnostics_,
             fmt::format("the text lacks function '{}' of the lobe", name),
             expected(signature, name), "no such function");
      return std::nullopt;
    }
    SourceLocation where = module_.where(*function);
    where.path = source_.where.path;
    if (!has_shape(signature, *function)) {
      misfit(where, diagnostics_, fmt::format("function '{}' of the lobe does not fit", name),
             expected(signature, name), declaration(*function));
      return std::nullopt;
    }
    LobeFunction found{function, {}};
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const std::size_t at = signature.leading.size() + i;
      auto value =
          fitted({name, function->parameters[at], at + 1, inputs_[i], true}, where, diagnostics_);
      if (!value) return std::nullopt;
      found.inputs.push_back(std::move(*value));
    }
    return found;
  }

 private:
  static std::vector<NodeCall::Port> of_functions(const NodeCall& call) {
    std::vector<NodeCall::Port> ports;
    for (const NodeCall::Port& port : call.inputs()) {
      if (!is_for_kernel(port)) ports.push_back(port);
    }
    return ports;
  }

  bool has_shape(const Signature& signature, const glsl::Function& function) const {
    const std::size_t count = signature.leading.size();
    if (function.type != signature.returns) return false;
    if (function.parameters.size() != count + inputs_.size()) return false;
    for (std::size_t i = 0; i < count; ++i) {
      const glsl::Function::Parameter& parameter = function.parameters[i];
      const bool may_be_vec2 = signature.leading[i] == "xi" && parameter.type == vec2;
      if (parameter.out || (parameter.type != vec3 && !may_be_vec2)) return false;
    }
    return true;
  }

  std::string expected(const Signature& signature, const std::string& name) const {
    std::string parameters;
    const auto add = [&](const std::string& type, std::string_view parameter) {
      parameters += fmt::format("{}{} {}", parameters.empty() ? "" : ", ", type, parameter);
    };
    for (const std::string_view parameter : signature.leading) add("vec3", parameter);
    for (const TextPorts::Port& input : inputs_) add(named_type(input.value.type), input.name);
    return fmt::format("{} {}({})", to_string(signature.returns), name, parameters);
  }

  const NodeText& source_;
  const glsl::Module& module_;
  Diagnostics& diagnostics_;
  const TextPorts ports_;
  std::vector<TextPorts::Port> inputs_;
};

}  // namespace

bool is_for_kernel(const NodeCall::Port& input) {
  if (input.name == "weight") return input.value.type == Type::float_;
  return (input.name == "normal" || input.name == "tangent") && input.value.type == Type::vector3;
}

std::optional<LobeFunctions> find_lobe_functions(const NodeText& source,
                                                 std::shared_ptr<const glsl::Module> module,
                                                 NodeCall& call, Diagnostics& diagnostics) {
  FunctionFinder finder(source, *module, call, diagnostics);
  if (!finder.can_pass_inputs(call)) return std::nullopt;
  LobeFunctions functions;
  functions.module = std::move(module);
  bool is_whole = true;
  const auto find = [&](LobeFunction& place, const Signature& signature) {
    auto found = finder.find(signature);
    is_whole = is_whole && found.has_value();
    if (found) place = std::move(*found);
  };
  find(functions.evaluate, {"evaluate", vec3, {"wo", "wi"}});
  find(functions.sample, {"sample", vec3, {"wo", "xi"}});
  find(functions.pdf, {"pdf", glsl::float_type, {"wo", "wi"}});
  find(functions.albedo, {"albedo", vec3, {"wo"}});
  find(functions.throughput, {"throughput", vec3, {"wo"}, true});
  find(functions.roughness, {"roughness", glsl::float_type, {}, true});
  return is_whole ? std::optional(std::move(functions)) : std::nullopt;
}

}  // namespace nacre
