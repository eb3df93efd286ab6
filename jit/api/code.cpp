// Machine code for hosts that call it by themselves.
#include <nacre/code.h>

#include "jit/api/call.h"
#include "jit/api/handles.h"
#include "jit/api/run_status.h"
#include "jit/shading/bound_code.h"
#include "runtime/float_environment.h"

using namespace nacre;
using namespace nacre::api;

struct nacre_code {
  std::shared_ptr<const ShaderData> data;
  std::unique_ptr<const BoundCode> code;
};

namespace {

nacre_status call_code(const nacre_code* code, const void* const* inputs, void* const* outputs,
                       uint64_t count) {
  return status_of(code->code->run(inputs, outputs, count));
}

}  // namespace

nacre_status nacre_code_create(const nacre_shader* shader, nacre_entry entry,
                               const nacre_instance* instance, int single, nacre_report* report,
                               nacre_code** code) {
  if (code == nullptr) return NACRE_WRONG_ARGUMENTS;
  *code = nullptr;
  if (shader == nullptr || entry == NACRE_EVALUATE_AT) return NACRE_WRONG_ARGUMENTS;
  if (instance != nullptr && instance->data != shader->data) return NACRE_WRONG_ARGUMENTS;
  return guarded(report, [&] {
    Said said(report);
    const auto refused = [&](const char* why) {
      said.diagnostics().error("no-code", {}, why);
      return nacre_status{NACRE_FAILED};
    };
    const BoundKernel* kernel = shader->data->kernel(entry);
    if (kernel == nullptr) return refused("the shader has no such entry");
    if (kernel->is_pending()) return refused("the machine code is still being made");
    const auto& block = instance != nullptr ? instance->block : shader->data->block();
    std::vector<std::uint32_t> parameters;
    for (const std::uint32_t place : shader->data->slots(entry)) parameters.push_back(block[place]);
    auto made = std::make_unique<nacre_code>();
    made->data = shader->data;
    made->code = kernel->code(std::move(parameters), single != 0);
    if (made->code == nullptr) {
      return refused(single != 0 ? "there is no machine code for single points"
                                 : "the entry has no machine code, it is interpreted");
    }
    *code = made.release();
    return nacre_status{NACRE_OK};
  });
}

void nacre_code_destroy(nacre_code* code) { delete code; }

int nacre_code_lanes(const nacre_code* code) {
  return code == nullptr ? 0 : code->code->code.lanes;
}

nacre_function nacre_code_function(const nacre_code* code) {
  return code == nullptr ? nullptr : call_code;
}

uint32_t nacre_enter(void) { return enter_float_environment(); }

void nacre_leave(uint32_t environment) { leave_float_environment(environment); }
