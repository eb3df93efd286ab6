#include "jit/glsl/preprocess.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "jit/glsl/condition.h"

namespace nacre::glsl {

namespace {

constexpr int max_nesting = 64;
constexpr std::size_t max_parameters = 256;

class Preprocessor {
 public:
  Preprocessor(Sources& sources, const PreprocessOptions& options, Definitions& definitions,
               Diagnostics& diagnostics)
      : sources_(sources),
        options_(options),
        diagnostics_(diagnostics),
        macros_(definitions.macros),
        tokens_(definitions.tokens) {}

  std::vector<Token> run(std::uint32_t file) {
    read(file);
    Token end;  // Complaints about a missing rest point at what it should follow.
    end.place = output_.empty() ? Place{file, 1, 1} : output_.back().place;
    output_.push_back(end);
    return std::move(output_);
  }

 private:
  using Tokens = std::span<const Token>;

  void read(std::uint32_t file) {
    seen_.insert(sources_.file(file).name);
    if (++depth_ > max_nesting || static_cast<int>(seen_.size()) > options_.max_files) {
      error({file, 1, 1}, "glsl-too-many-files", "there are too many or too deeply nested includes",
            fmt::format("at most {} files, {} deep", options_.max_files, max_nesting));
    }
    bytes_ += sources_.file(file).text.size();
    if (bytes_ > options_.max_bytes) {
      error({file, 1, 1}, "glsl-too-large", "the text is too large with all it includes",
            fmt::format("at most {} bytes", options_.max_bytes));
    }
    const std::vector<Token> tokens = lex(sources_, file);
    const std::size_t conditions = conditions_.size();
    std::size_t at = 0;
    while (tokens[at].kind != Token::Kind::end) {
      const std::size_t line_end = end_of_line(tokens, at);
      if (tokens[at].starts_line && tokens[at].is("#")) {
        directive(Tokens(tokens).subspan(at, line_end - at));
        at = line_end;
        continue;
      }
      // An invocation may span lines, so a run of lines is expanded as one.
      std::size_t stop = line_end;
      while (tokens[stop].kind != Token::Kind::end && !tokens[stop].is("#")) {
        stop = end_of_line(tokens, stop);
      }
      if (active()) expand(Tokens(tokens).subspan(at, stop - at), 0, output_);
      at = stop;
    }
    if (conditions_.size() != conditions) {
      error(tokens.back().place, "glsl-directive", "an #if is not closed", "#endif");
    }
    --depth_;
  }

  static std::size_t end_of_line(const std::vector<Token>& tokens, std::size_t at) {
    for (++at; tokens[at - 1].kind != Token::Kind::end && at < tokens.size(); ++at) {
      if (tokens[at].starts_line || tokens[at].kind == Token::Kind::end) return at;
    }
    return tokens.size() - 1;
  }

  bool active() const { return conditions_.empty() || conditions_.back().active; }

  void directive(Tokens line) {
    if (line.size() < 2) return;
    const std::string_view name = line[1].text;
    const Tokens rest = line.subspan(2);
    if (name == "if" || name == "ifdef" || name == "ifndef") {
      open_condition(name, line);
    } else if (name == "elif" || name == "else" || name == "endif") {
      next_condition(name, line);
    } else if (!active()) {
      return;
    } else if (name == "define") {
      define(line);
    } else if (name == "undef") {
      if (!rest.empty()) macros_.erase(rest[0].text);
    } else if (name == "include") {
      include(line);
    } else if (name == "error") {
      error(line[0].place, "glsl-error-directive", "the text has an #error here");
    } else if (name != "version" && name != "extension" && name != "pragma" && name != "line") {
      error(line[1].place, "glsl-directive", fmt::format("there is no directive '#{}'", name));
    }
  }

  // -- #if ... #endif

  struct Condition {
    bool active = false;  ///< And all around it.
    bool taken = false;   ///< A branch of it was active.
  };

  void open_condition(std::string_view name, Tokens line) {
    Condition condition;
    if (active()) {
      if (name == "if") {
        condition.active = evaluate(line.subspan(2), line[0].place);
      } else {
        if (line.size() < 3) error(line[0].place, "glsl-directive", "a name is missing", "a macro");
        condition.active = macros_.contains(line[2].text) == (name == "ifdef");
      }
      condition.taken = condition.active;
    } else {
      condition.taken = true;
    }
    conditions_.push_back(condition);
  }

  void next_condition(std::string_view name, Tokens line) {
    if (conditions_.empty()) {
      error(line[0].place, "glsl-directive", fmt::format("#{} without #if", name));
    }
    const Condition before = conditions_.back();
    conditions_.pop_back();
    if (name == "endif") return;
    Condition condition = before;
    condition.active = false;
    if (active() && !before.taken) {
      condition.active = name == "else" || evaluate(line.subspan(2), line[0].place);
      condition.taken = condition.active;
    }
    conditions_.push_back(condition);
  }

  bool evaluate(Tokens line, Place place) {
    std::vector<Token> replaced;
    spend(line.size(), place);
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (!line[i].is("defined")) {
        replaced.push_back(line[i]);
        continue;
      }
      const bool parenthesis = i + 1 < line.size() && line[i + 1].is("(");
      const std::size_t name = i + (parenthesis ? 2 : 1);
      if (name >= line.size()) error(place, "glsl-directive", "'defined' needs a name");
      Token value = line[name];
      value.kind = Token::Kind::integer;
      value.text = macros_.contains(line[name].text) ? "1" : "0";
      replaced.push_back(value);
      i = name + (parenthesis ? 1 : 0);
    }
    std::vector<Token> expanded;
    expand(replaced, 0, expanded);
    const std::optional<long long> value = evaluate_condition(expanded);
    if (!value) error(place, "glsl-directive", "the condition is not an integer expression");
    return *value != 0;
  }

  // -- #define, #include

  void define(Tokens line) {
    if (line.size() < 3 || line[2].kind != Token::Kind::name) {
      error(line[0].place, "glsl-directive", "#define needs a name");
    }
    const Token& name = line[2];
    Macro macro;
    std::size_t at = 3;
    // A parenthesis makes parameters only where nothing separates it from the name.
    if (at < line.size() && line[at].is("(") && line[at].place.line == name.place.line &&
        line[at].place.column == name.place.column + static_cast<int>(name.text.size())) {
      macro.is_function = true;
      for (++at; at < line.size() && !line[at].is(")"); ++at) {
        if (!line[at].is(",")) macro.parameters.push_back(line[at].text);
      }
      if (macro.parameters.size() > max_parameters) {
        error(name.place, "glsl-macro", "the macro has too many parameters",
              fmt::format("at most {}", max_parameters));
      }
      if (at >= line.size()) error(name.place, "glsl-directive", "a parameter list is not closed");
      ++at;
    }
    macro.body.assign(line.begin() + static_cast<std::ptrdiff_t>(at), line.end());
    macros_.insert_or_assign(name.text, std::move(macro));
  }

  void include(Tokens line) {
    if (line.size() < 3 || line[2].kind != Token::Kind::text) {
      error(line[0].place, "glsl-directive", "#include needs a file name in quotes");
    }
    std::string name(line[2].text);
    const std::size_t dollar = name.find('$');
    if (dollar != std::string::npos) {
      const auto found = tokens_.find(std::string_view(name).substr(dollar + 1));
      if (found != tokens_.end()) name = name.substr(0, dollar) + std::string(found->second);
    }
    std::optional<Sources::File> file;
    spend(1000, line[0].place);  // Looking for it costs much more than a token.
    if (options_.find_include) {
      file = options_.find_include(name, sources_.file(line[2].place.file).name);
    }
    if (!file) error(line[2].place, "glsl-include", fmt::format("'{}' was not found", name));
    spend(file->text.size() / 16, line[0].place);
    if (!seen_.contains(file->name)) read(sources_.add(std::move(*file)));
  }

  // -- Macros

  /// Counts what leaves no trace in the result: macros that stand for nothing too take time.
  void spend(std::size_t steps, Place place) {
    steps_ += steps;
    if (steps_ > options_.max_steps) {
      error(place, "glsl-too-large", "the text takes too long to expand its macros",
            fmt::format("at most {} steps", options_.max_steps));
    }
    if (steps_ < next_look_) return;
    next_look_ = steps_ + 65536;
    check_stop(options_.stop, sources_, diagnostics_, place);
  }

  void expand(Tokens tokens, int depth, std::vector<Token>& into) {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      spend(1, tokens[i].place);
      const auto found =
          tokens[i].kind == Token::Kind::name ? macros_.find(tokens[i].text) : macros_.end();
      if (found == macros_.end() || expanding_.contains(tokens[i].text)) {
        put(tokens[i], into);
        continue;
      }
      const Token& name = tokens[i];
      const Macro& macro = found->second;
      if (depth > max_nesting) {
        error(name.place, "glsl-macro", "macros are nested too deeply");
      }
      if (macro.is_function && (i + 1 >= tokens.size() || !tokens[i + 1].is("("))) {
        put(name, into);
        continue;
      }
      spend(macro.body.size(), name.place);
      std::vector<Token> body =
          macro.is_function ? substitute(macro, name, tokens, i, depth) : macro.body;
      // Complaints about what a macro stands for belong where it is used.
      for (Token& token : body) token.place = name.place;
      expanding_.insert(name.text);
      expand(body, depth + 1, into);
      expanding_.erase(name.text);
    }
  }

  /// Reads the arguments after tokens[i], moves i to the closing parenthesis.
  std::vector<Token> substitute(const Macro& macro, const Token& name, Tokens tokens,
                                std::size_t& i, int depth) {
    std::vector<std::vector<Token>> arguments(1);
    int open = 0;
    for (++i; i < tokens.size(); ++i) {
      const Token& token = tokens[i];
      spend(1, name.place);
      if (token.is("(") && ++open == 1) continue;
      if (token.is(")") && --open == 0) break;
      if (token.is(",") && open == 1) {
        arguments.emplace_back();
      } else {
        arguments.back().push_back(token);
      }
    }
    if (i >= tokens.size()) error(name.place, "glsl-macro", "the arguments are not closed", ")");
    if (arguments.size() == 1 && arguments[0].empty() && macro.parameters.empty()) {
      arguments.clear();
    }
    if (arguments.size() != macro.parameters.size()) {
      error(name.place, "glsl-macro",
            fmt::format("macro '{}' has the wrong number of arguments", name.text),
            std::to_string(macro.parameters.size()), std::to_string(arguments.size()));
    }
    std::vector<Token> body;
    for (const Token& token : macro.body) {
      const auto parameter =
          std::find(macro.parameters.begin(), macro.parameters.end(), token.text);
      if (token.kind != Token::Kind::name || parameter == macro.parameters.end()) {
        put(token, body);
        continue;
      }
      const auto index = static_cast<std::size_t>(parameter - macro.parameters.begin());
      std::vector<Token> expanded;
      expand(arguments[index], depth + 1, expanded);
      for (const Token& inner : expanded) put(inner, body);
    }
    return body;
  }

  void put(const Token& token, std::vector<Token>& into) {
    if (++count_ > options_.max_tokens) {
      error(token.place, "glsl-too-large", "the text is too large once macros are expanded",
            fmt::format("at most {} tokens", options_.max_tokens));
    }
    into.push_back(token);
  }

  [[noreturn]] void error(Place place, std::string code, std::string message,
                          std::string expected = {}, std::string found = {}) {
    fail(sources_, diagnostics_, place, std::move(code), std::move(message), std::move(expected),
         std::move(found));
  }

  Sources& sources_;
  const PreprocessOptions& options_;
  Diagnostics& diagnostics_;
  std::map<std::string_view, Macro>& macros_;
  const std::map<std::string_view, std::string_view>& tokens_;
  std::set<std::string_view> expanding_;
  std::set<std::string, std::less<>> seen_;
  std::vector<Condition> conditions_;
  std::vector<Token> output_;
  std::size_t count_ = 0;
  std::size_t steps_ = 0;
  std::size_t next_look_ = 65536;
  std::size_t bytes_ = 0;
  int depth_ = 0;
};

}  // namespace

void define_token(Sources& sources, Definitions& definitions, std::string_view name,
                  std::string_view text) {
  const std::string_view kept = sources.intern(fmt::format("${}", name));
  const std::uint32_t file = sources.add({std::string(kept), std::string(text)});
  Macro macro;
  macro.body = lex(sources, file);
  macro.body.pop_back();
  definitions.macros.insert_or_assign(kept, std::move(macro));
  definitions.tokens.insert_or_assign(kept.substr(1), sources.file(file).text);
}

std::vector<Token> preprocess(Sources& sources, std::uint32_t file,
                              const PreprocessOptions& options, Definitions& definitions,
                              Diagnostics& diagnostics) {
  return Preprocessor(sources, options, definitions, diagnostics).run(file);
}

}  // namespace nacre::glsl
