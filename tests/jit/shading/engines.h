#pragma once

#include <gtest/gtest.h>

#include <string>

#include "jit/shading/shading_system.h"

namespace nacre {

/// All there are, for tests of what each must give.
inline auto all_engines() {
  return ::testing::Values(Backend::jit, Backend::interpreter, Backend::reference);
}

inline std::string engine_name(const ::testing::TestParamInfo<Backend>& engine) {
  if (engine.param == Backend::jit) return "jit";
  return engine.param == Backend::interpreter ? "interpreter" : "reference";
}

}  // namespace nacre
