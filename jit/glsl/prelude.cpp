#include "jit/glsl/prelude.h"

#include <cassert>

#include "jit/glsl/parse.h"
#include "jit/glsl/prelude_text.h"

namespace nacre::glsl {

std::shared_ptr<const Prelude> Prelude::read() {
  auto prelude = std::shared_ptr<Prelude>(new Prelude);
  Diagnostics diagnostics;
  for (const PreludeToken& token : prelude_tokens) {
    define_token(prelude->sources_, prelude->definitions_, token.name, token.text);
  }
  const std::uint32_t file = prelude->sources_.add({"<prelude>", std::string(glsl::prelude_text)});
  const std::vector<Token> tokens =
      preprocess(prelude->sources_, file, {}, prelude->definitions_, diagnostics);
  parse(tokens, prelude->sources_, diagnostics, prelude->syntax_);
  assert(!diagnostics.has_errors());
  return prelude;
}

}  // namespace nacre::glsl
