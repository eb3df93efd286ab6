#include "jit/glsl/module.h"

#include <algorithm>

#include "jit/glsl/parse.h"
#include "jit/glsl/prelude.h"

namespace nacre::glsl {

namespace {

/// The prelude and a text as one run of tokens, so that the prelude's macros
/// hold in the text; an include keeps the lines of the text as they are.
std::vector<Token> tokens_after_prelude(Sources& sources, const std::string& name, std::string text,
                                        PreprocessOptions options, Diagnostics& diagnostics) {
  for (const PreludeToken& token : prelude_tokens) {
    options.tokens.emplace(token.name, token.text);
  }
  const std::uint32_t start =
      sources.add("<prelude>", std::string(prelude) + "#include \"<text>\"\n");
  const FindInclude find_others = options.find_include;
  options.find_include = [&](const std::string& wanted,
                             const std::string& from) -> std::optional<Sources::File> {
    if (from == "<prelude>") return Sources::File{name, std::move(text)};
    return find_others ? find_others(wanted, from) : std::nullopt;
  };
  return preprocess(sources, start, options, diagnostics);
}

}  // namespace

std::shared_ptr<const Module> Module::read(const std::string& name, std::string text,
                                           const PreprocessOptions& options,
                                           Diagnostics& diagnostics) {
  auto module = std::shared_ptr<Module>(new Module);
  try {
    const std::vector<Token> tokens =
        tokens_after_prelude(module->sources_, name, std::move(text), options, diagnostics);
    parse(tokens, module->sources_, diagnostics, module->syntax_);
  } catch (const Failure&) {
    return nullptr;
  }
  return module;
}

std::shared_ptr<const Module> Module::read_expression(const std::string& name, std::string text,
                                                      Diagnostics& diagnostics) {
  auto module = std::shared_ptr<Module>(new Module);
  try {
    const std::vector<Token> tokens =
        tokens_after_prelude(module->sources_, name, std::move(text), {}, diagnostics);
    const auto is_prelude = [](const Token& token) { return token.place.file == 0; };
    const auto split = std::find_if_not(tokens.begin(), tokens.end(), is_prelude);
    std::vector<Token> before(tokens.begin(), split);
    before.push_back(tokens.back());
    before.back().kind = Token::Kind::end;
    parse(before, module->sources_, diagnostics, module->syntax_);
    const std::vector<Token> after(split, tokens.end());
    module->expression_ = parse_expression(after, module->sources_, diagnostics, module->syntax_);
  } catch (const Failure&) {
    return nullptr;
  }
  return module;
}

const Function* Module::function(std::string_view name) const {
  const auto found = syntax_.by_name.find(name);
  return found == syntax_.by_name.end() ? nullptr : found->second.back();
}

std::optional<CallResult> Module::record(const Function& function, std::vector<Value> arguments,
                                         Recorder& recorder, Diagnostics& diagnostics,
                                         const TextureLookup& texture) const {
  const RecordContext context{sources_, syntax_, recorder, diagnostics, {}, texture};
  try {
    return record_call(context, function, std::move(arguments));
  } catch (const Failure&) {
    return std::nullopt;
  }
}

std::optional<Value> Module::record_expression(
    const std::vector<std::pair<std::string_view, Value>>& names, Recorder& recorder,
    Diagnostics& diagnostics) const {
  const RecordContext context{sources_, syntax_, recorder, diagnostics, {}, {}};
  try {
    return glsl::record_expression(context, *expression_, names);
  } catch (const Failure&) {
    return std::nullopt;
  }
}

}  // namespace nacre::glsl
