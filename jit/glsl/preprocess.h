#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "jit/glsl/token.h"

namespace nacre::glsl {

/// Finds what `#include "name"` means in the file `from`.
using FindInclude =
    std::function<std::optional<Sources::File>(const std::string& name, const std::string& from)>;

struct PreprocessOptions {
  FindInclude find_include;  ///< Null: includes are errors.
  /// "$name" in the text and in names of included files: what MaterialX's
  /// generators put in their place.
  std::map<std::string, std::string, std::less<>> tokens;
  std::size_t max_tokens = 1'000'000;  ///< After expansion.
  int max_files = 256;
};

/// The tokens of a file and of all it includes (each file once), directives
/// carried out and macros expanded: #include, #define, #undef, #if, #ifdef,
/// #ifndef, #elif, #else, #endif; #version, #extension, #pragma and #line are
/// passed over. The last token is `end`. Throws Failure.
std::vector<Token> preprocess(Sources& sources, std::uint32_t file,
                              const PreprocessOptions& options, Diagnostics& diagnostics);

}  // namespace nacre::glsl
