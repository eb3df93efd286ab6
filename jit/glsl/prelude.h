#pragma once

#include <memory>

#include "jit/glsl/preprocess.h"
#include "jit/glsl/syntax.h"

namespace nacre::glsl {

/// The names that MaterialX's GLSL takes for granted (prelude_text.h), read once for any
/// number of texts. Never changed once made; may be shared between threads.
class Prelude {
 public:
  static std::shared_ptr<const Prelude> read();

  const Sources& sources() const { return sources_; }
  const Definitions& definitions() const { return definitions_; }
  const Syntax& syntax() const { return syntax_; }

 private:
  Prelude() = default;

  Sources sources_;
  Definitions definitions_;
  Syntax syntax_;
};

}  // namespace nacre::glsl
