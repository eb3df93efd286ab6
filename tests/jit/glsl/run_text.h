#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "jit/glsl/module.h"
#include "tests/support/run_kernel.h"

namespace nacre {

/// What reading and recording a text came to.
struct TextRun {
  DoubleColumns columns;  ///< "result" or "result.<part>"; empty after a fault.
  Diagnostics diagnostics;
  Program program;
};

/// Calls `f` of a text, whose parameters are floats, with one column each
/// ("a0", "a1", ...), in double precision.
inline TextRun run_text(const std::string& text, const std::vector<std::vector<float>>& columns,
                        const glsl::PreprocessOptions& options = {}) {
  TextRun run;
  const auto module =
      glsl::Module::read(glsl::Prelude::read(), {"text.glsl", text}, options, run.diagnostics);
  if (module == nullptr) return run;
  const glsl::Function* function = module->function("f");
  if (function == nullptr) return run;
  Recorder recorder;
  Columns inputs;
  std::vector<glsl::Value> arguments;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string name = "a" + std::to_string(i);
    inputs[name] = columns[i];
    arguments.push_back(glsl::make(input(recorder, name)));
  }
  const auto result = module->record(*function, arguments, recorder, run.diagnostics);
  if (!result) return run;
  std::vector<SliceOutput> outputs;
  const std::vector<Ref>& parts = result->value.parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string name = parts.size() == 1 ? "result" : "result." + std::to_string(i);
    outputs.push_back({name, parts[i]});
  }
  run.program = slice(recorder.program(), "text", outputs);
  EXPECT_EQ(verify(run.program), "");
  run.columns = run_double(*make_reference(run.program), inputs);
  return run;
}

/// The same where it must work.
inline std::vector<double> results(const std::string& text,
                                   const std::vector<std::vector<float>>& columns) {
  const TextRun run = run_text(text, columns);
  EXPECT_FALSE(run.diagnostics.has_errors()) << run.diagnostics.to_string();
  const auto found = run.columns.find("result");
  return found == run.columns.end() ? std::vector<double>{} : found->second;
}

}  // namespace nacre
