#pragma once

#include <string>

#include "jit/document/document.h"
#include "jit/shading/shading_system.h"

namespace nacre::fuzz {

/// The data library and what runs documents, made once a process: reading the
/// library takes a thousand times what one document does.
ShadingSystem& host();

/// The interpreter, and limits small enough that one input costs milliseconds.
ShaderOptions shader_options();
ReadOptions read_options();

/// How far one document was taken.
struct Shaded {
  bool clean = false;  ///< Checking found no error.
  int kernels = 0;     ///< That ran.
};

/// Everything a host does with a document it was given: checks all of it, then compiles
/// and runs each output, and each kernel of each material, on a few points, whatever
/// checking said. Fails where a compile is refused without a word, and with `agreeing` where
/// it is refused, or complained of, and checking was not.
Shaded shade_everything(const Document& document, const ShaderOptions& options = shader_options(),
                        bool agreeing = false);

/// Ends the process, so that the fuzzer keeps the input.
[[noreturn]] void fail(const std::string& reason);

}  // namespace nacre::fuzz
