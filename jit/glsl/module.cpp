#include "jit/glsl/module.h"

#include "jit/glsl/parse.h"

namespace nacre::glsl {

Module::Module(const std::shared_ptr<const Prelude>& prelude)
    : sources_(std::shared_ptr<const Sources>(prelude, &prelude->sources())),
      syntax_(prelude->syntax()) {}

std::shared_ptr<const Module> Module::read(const std::shared_ptr<const Prelude>& prelude,
                                           Sources::File text, const PreprocessOptions& options,
                                           Diagnostics& diagnostics) {
  auto module = std::shared_ptr<Module>(new Module(prelude));
  try {
    Definitions definitions = prelude->definitions();
    const std::uint32_t file = module->sources_.add(std::move(text));
    const std::vector<Token> tokens =
        preprocess(module->sources_, file, options, definitions, diagnostics);
    parse(tokens, module->sources_, diagnostics, module->syntax_, options.stop);
  } catch (const Failure&) {
    return nullptr;
  }
  return module;
}

std::shared_ptr<const Module> Module::read_expression(const std::shared_ptr<const Prelude>& prelude,
                                                      Sources::File text, Diagnostics& diagnostics,
                                                      const Stop& stop) {
  auto module = std::shared_ptr<Module>(new Module(prelude));
  try {
    Definitions definitions = prelude->definitions();
    const std::uint32_t file = module->sources_.add(std::move(text));
    const std::vector<Token> tokens =
        preprocess(module->sources_, file, {.stop = stop}, definitions, diagnostics);
    if (tokens.size() == 1) {
      const Sources::File& empty = module->sources_.file(file);
      diagnostics.error("glsl-syntax", {empty.name, empty.first_line, 0, ""}, "the text is empty",
                        "an expression");
      return nullptr;
    }
    module->expression_ =
        parse_expression(tokens, module->sources_, diagnostics, module->syntax_, stop);
  } catch (const Failure&) {
    return nullptr;
  }
  return module;
}

const Function* Module::function(std::string_view name) const {
  const auto found = syntax_.by_name.find(name);
  return found == syntax_.by_name.end() ? nullptr : found->second.back();
}

SourceLocation Module::where(const Function& function) const {
  return location(sources_, function.place);
}

std::optional<CallResult> Module::record(const Function& function, std::vector<Value> arguments,
                                         Recorder& recorder, Diagnostics& diagnostics,
                                         const TextureLookup& texture,
                                         const RecordLimits& limits) const {
  const RecordContext context{sources_, syntax_, recorder, diagnostics, limits, texture};
  try {
    return record_call(context, function, std::move(arguments));
  } catch (const Failure&) {
    return std::nullopt;
  }
}

std::optional<Value> Module::record_expression(
    const std::vector<std::pair<std::string_view, Value>>& names, Recorder& recorder,
    Diagnostics& diagnostics, const RecordLimits& limits) const {
  const RecordContext context{sources_, syntax_, recorder, diagnostics, limits, {}};
  try {
    return glsl::record_expression(context, *expression_, names);
  } catch (const Failure&) {
    return std::nullopt;
  }
}

}  // namespace nacre::glsl
