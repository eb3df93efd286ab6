// Bytes as a text of the GLSL subset: read, recorded with every argument unknown,
// and run. The first byte says whether it is an expression or functions.
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "jit/glsl/module.h"
#include "runtime/program/slice.h"
#include "tests/fuzz/host.h"
#include "tests/support/run_kernel.h"

namespace {

using namespace nacre;

/// Small enough that one input costs milliseconds.
const glsl::RecordLimits limits{.loop_iterations = 16, .operations = 20'000, .steps = 50'000};

void run(const Recorder& recorder, const std::vector<Ref>& parts) {
  std::vector<SliceOutput> outputs;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    outputs.push_back({"out" + std::to_string(i), parts[i]});
  }
  if (outputs.empty()) return;
  const Program program = slice(recorder.program(), "text", outputs);
  if (const std::string fault = verify(program); !fault.empty()) fuzz::fail(fault);
  run_double(*make_reference(program), {{"a", {0.0f, 0.5f, -3.0f, 1e30f}}});
}

glsl::Value unknown(Recorder& recorder, const glsl::Type& type) {
  glsl::Value value = glsl::zero(type);
  for (std::size_t i = 0; i < value.parts.size(); ++i) {
    const Float number(recorder.input("a", Scalar::f32));
    value.parts[i] = glsl::convert((number + static_cast<float>(i)).ref(), glsl::Base::number,
                                   glsl::part_base(type, static_cast<int>(i)));
  }
  return value;
}

void run_expression(const std::string& text) {
  Diagnostics diagnostics;
  const auto module =
      glsl::Module::read_expression(glsl::Prelude::read(), {"text", text}, diagnostics);
  if ((module == nullptr) != diagnostics.has_errors()) fuzz::fail("refused without a reason");
  if (module == nullptr) return;
  Recorder recorder;
  const glsl::Type vec3 = glsl::float_type.with_rows(3);
  const auto value = module->record_expression(
      {{"a", unknown(recorder, glsl::float_type)}, {"b", unknown(recorder, vec3)}}, recorder,
      diagnostics, limits);
  if (value.has_value() == diagnostics.has_errors()) fuzz::fail("refused without a reason");
  if (value) run(recorder, value->parts);
}

void run_functions(const std::string& text) {
  Diagnostics diagnostics;
  const auto module = glsl::Module::read(glsl::Prelude::read(), {"text", text}, {}, diagnostics);
  if ((module == nullptr) != diagnostics.has_errors()) fuzz::fail("refused without a reason");
  if (module == nullptr) return;
  const glsl::Function* function = module->function("f");
  if (function == nullptr || function->parameters.size() > 16) return;
  Recorder recorder;
  std::vector<glsl::Value> arguments;
  for (const auto& parameter : function->parameters) {
    if (glsl::part_count(parameter.type) > 64) return;
    arguments.push_back(unknown(recorder, parameter.type));
  }
  const auto result =
      module->record(*function, std::move(arguments), recorder, diagnostics, {}, limits);
  if (result.has_value() == diagnostics.has_errors()) fuzz::fail("refused without a reason");
  if (!result) return;
  run(recorder, result->value.parts);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 2 == 0) {
    run_expression(text);
  } else {
    run_functions(text);
  }
  return 0;
}
