#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "jit/glsl/token.h"
#include "runtime/stop.h"

namespace nacre::glsl {

/// Finds what `#include "name"` means in the file `from`.
using FindInclude =
    std::function<std::optional<Sources::File>(const std::string& name, const std::string& from)>;

struct PreprocessOptions {
  FindInclude find_include = {};       ///< Null: includes are errors.
  std::size_t max_tokens = 1'000'000;  ///< After expansion.
  /// Tokens looked at and macros replaced while expanding, those included of which nothing
  /// is left, in the text and in conditions.
  std::size_t max_steps = 4'000'000;
  int max_files = 256;
  std::size_t max_bytes = 8'000'000;  ///< Of all files.
  Stop stop = {};
};

struct Macro {
  bool is_function = false;
  std::vector<std::string_view> parameters;
  std::vector<Token> body;
};

/// What is defined where a text starts, and where it ends.
struct Definitions {
  std::map<std::string_view, Macro> macros;
  /// "$name" in names of included files: what MaterialX's generators put in their place.
  std::map<std::string_view, std::string_view> tokens;
};

/// Defines "$name", in the text and in names of included files.
void define_token(Sources& sources, Definitions& definitions, std::string_view name,
                  std::string_view text);

/// The tokens of a file and of all it includes (each file once), directives
/// carried out and macros expanded: #include, #define, #undef, #if, #ifdef,
/// #ifndef, #elif, #else, #endif; #version, #extension, #pragma and #line are
/// passed over. The last token is `end`. Throws Failure.
std::vector<Token> preprocess(Sources& sources, std::uint32_t file,
                              const PreprocessOptions& options, Definitions& definitions,
                              Diagnostics& diagnostics);

}  // namespace nacre::glsl
