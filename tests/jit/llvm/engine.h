#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "jit/llvm/codegen.h"
#include "jit/llvm/session.h"

namespace nacre {

/// One session for all tests of a program.
inline const std::shared_ptr<JitSession>& session() {
  static const std::shared_ptr<JitSession> made = [] {
    Diagnostics diagnostics;
    auto result = JitSession::create({}, diagnostics);
    EXPECT_NE(result, nullptr) << diagnostics.to_string();
    return result;
  }();
  return made;
}

/// Compiles and loads; fails the test and gives null if that goes wrong.
inline std::shared_ptr<const Kernel> compiled(const Program& program,
                                              const CodegenOptions& options) {
  Diagnostics diagnostics;
  const std::optional<ObjectCode> object = compile_object(program, options, diagnostics);
  std::shared_ptr<const LoadedCode> code;
  if (object) code = session()->load(*object, diagnostics);
  EXPECT_NE(code, nullptr) << diagnostics.to_string();
  return code == nullptr ? nullptr : make_jit_kernel(program, code, options.lanes);
}

}  // namespace nacre
