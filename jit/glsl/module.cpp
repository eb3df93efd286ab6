#include "jit/glsl/module.h"

#include <algorithm>

#include "jit/glsl/parse.h"
#include "jit/glsl/prelude.h"

namespace nacre::glsl {

namespace {

/// The prelude and a text as one run of tokens, so that the prelude's macros
/// hold in the text; an include keeps the lines of the text as they are.
std::vector<Token> tokens_after_prelude(Sources& sources, Sources::File text,
                                        PreprocessOptions options, Diagnostics& diagnostics) {
  for (const PreludeToken& token : prelude_tokens) {
    options.tokens.emplace(token.name, token.text);
  }
  const std::uint32_t start =
      sources.add({"<prelude>", std::string(prelude) + "#include \"<text>\"\n"});
  const FindInclude find_others = options.find_include;
  options.find_include = [&](const std::string& wanted,
                             const std::string& from) -> std::optional<Sources::File> {
    if (from == "<prelude>") return std::move(text);
    return find_others ? find_others(wanted, from) : std::nullopt;
  };
  return preprocess(sources, start, options, diagnostics);
}

}  // namespace

std::shared_ptr<const Module> Module::read(Sources::File text, const PreprocessOptions& options,
                                           Diagnostics& diagnostics) {
  auto module = std::shared_ptr<Module>(new Module);
  try {
    const std::vector<Token> tokens =
        tokens_after_prelude(module->sources_, std::move(text), options, diagnostics);
    parse(tokens, module->sources_, diagnostics, module->syntax_);
  } catch (const Failure&) {
    return nullptr;
  }
  return module;
}

std::shared_ptr<const Module> Module::read_expression(Sources::File text,
                                                      Diagnostics& diagnostics) {
  const std::string name = text.name;
  const int line = text.first_line;
  auto module = std::shared_ptr<Module>(new Module);
  try {
    const std::vector<Token> tokens =
        tokens_after_prelude(module->sources_, std::move(text), {}, diagnostics);
    const auto is_prelude = [](const Token& token) { return token.place.file == 0; };
    const auto split = std::find_if_not(tokens.begin(), tokens.end() - 1, is_prelude);
    if (split == tokens.end() - 1) {
      diagnostics.error("glsl-syntax", {name, line, 0, ""}, "the text is empty", "an expression");
      return nullptr;
    }
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
