// What a host asks of a shader.
#include <atomic>
#include <memory>

#include "jit/api/call.h"
#include "jit/api/channels.h"
#include "jit/api/handles.h"

using namespace nacre;
using namespace nacre::api;

namespace {

const BoundKernel* kernel_of(const nacre_shader* shader, nacre_entry entry) {
  return shader != nullptr ? shader->data->kernel(entry) : nullptr;
}

nacre_status give_channel(const nacre_shader* shader, const std::vector<Channel>& list,
                          std::size_t index, ChannelList kind, nacre_channel* channel) {
  if (index >= list.size()) return NACRE_WRONG_ARGUMENTS;
  return give(channel, channel_info(list[index], shader->data->state(), kind));
}

const void* numbers(const std::vector<std::uint32_t>& bits) {
  return bits.empty() ? nullptr : bits.data();
}

}  // namespace

int nacre_shader_has(const nacre_shader* shader, nacre_entry entry) {
  return kernel_of(shader, entry) != nullptr ? 1 : 0;
}

size_t nacre_shader_input_count(const nacre_shader* shader, nacre_entry entry) {
  const BoundKernel* kernel = kernel_of(shader, entry);
  return kernel != nullptr ? kernel->program().inputs.size() : 0;
}

nacre_status nacre_shader_input(const nacre_shader* shader, nacre_entry entry, size_t index,
                                nacre_channel* channel) {
  const BoundKernel* kernel = kernel_of(shader, entry);
  if (kernel == nullptr) return NACRE_WRONG_ARGUMENTS;
  return give_channel(shader, kernel->program().inputs, index, ChannelList::inputs, channel);
}

size_t nacre_shader_result_count(const nacre_shader* shader, nacre_entry entry) {
  const BoundKernel* kernel = kernel_of(shader, entry);
  return kernel != nullptr ? kernel->program().outputs.size() : 0;
}

nacre_status nacre_shader_result(const nacre_shader* shader, nacre_entry entry, size_t index,
                                 nacre_channel* channel) {
  const BoundKernel* kernel = kernel_of(shader, entry);
  if (kernel == nullptr) return NACRE_WRONG_ARGUMENTS;
  return give_channel(
      shader, kernel->program().outputs, index,
      entry == NACRE_OUTPUTS ? ChannelList::results_of_outputs : ChannelList::results_of_material,
      channel);
}

size_t nacre_shader_state_count(const nacre_shader* shader) {
  return shader != nullptr ? shader->data->state().size() : 0;
}

int nacre_shader_has_back(const nacre_shader* shader) {
  return shader != nullptr && shader->data->has_back() ? 1 : 0;
}

size_t nacre_shader_lobe_count(const nacre_shader* shader) {
  return shader != nullptr ? shader->data->lobes().size() : 0;
}

nacre_status nacre_shader_lobe(const nacre_shader* shader, size_t index, nacre_lobe_info* info) {
  if (index >= nacre_shader_lobe_count(shader)) return NACRE_WRONG_ARGUMENTS;
  const LobeInfo& lobe = shader->data->lobes()[index];
  return give(
      info, {.size = 0, .name = lobe.name.c_str(), .path = lobe.path.c_str(), .kinds = lobe.kinds});
}

size_t nacre_shader_left_out_count(const nacre_shader* shader) {
  return shader != nullptr ? shader->data->left_out().size() : 0;
}

const char* nacre_shader_left_out(const nacre_shader* shader, size_t index, int* changes_picture) {
  if (index >= nacre_shader_left_out_count(shader)) return nullptr;
  const auto& [line, changes] = shader->data->left_out()[index];
  if (changes_picture != nullptr) *changes_picture = changes ? 1 : 0;
  return line.c_str();
}

size_t nacre_shader_fact_count(const nacre_shader* shader) {
  return shader != nullptr ? shader->data->facts().size() : 0;
}

nacre_status nacre_shader_fact(const nacre_shader* shader, size_t index, nacre_fact_info* info) {
  if (index >= nacre_shader_fact_count(shader)) return NACRE_WRONG_ARGUMENTS;
  const auto& [fact, saved] = shader->data->facts()[index];
  return give(info, {.size = 0,
                     .name = fact.name.c_str(),
                     .minimum = fact.low,
                     .maximum = fact.high,
                     .saved = saved ? std::uint64_t{*saved} : NACRE_NOT_KNOWN});
}

uint64_t nacre_shader_points_outside_facts(const nacre_shader* shader) {
  std::uint64_t points = 0;
  for (int entry = 0; entry < NACRE_ENTRY_COUNT; ++entry) {
    const BoundKernel* kernel = kernel_of(shader, static_cast<nacre_entry>(entry));
    if (kernel != nullptr) points += kernel->points_outside_facts();
  }
  return points;
}

int nacre_shader_is_pending(const nacre_shader* shader) {
  for (int entry = 0; entry < NACRE_ENTRY_COUNT; ++entry) {
    const BoundKernel* kernel = kernel_of(shader, static_cast<nacre_entry>(entry));
    if (kernel != nullptr && kernel->is_pending()) return 1;
  }
  return 0;
}

void nacre_shader_cancel(const nacre_shader* shader) {
  for (int entry = 0; entry < NACRE_ENTRY_COUNT; ++entry) {
    const BoundKernel* kernel = kernel_of(shader, static_cast<nacre_entry>(entry));
    if (kernel != nullptr) kernel->cancel();
  }
}

nacre_status nacre_shader_when_ready(const nacre_shader* shader, void (*call)(void* user),
                                     void* user) {
  if (shader == nullptr || call == nullptr) return NACRE_WRONG_ARGUMENTS;
  return guarded([&] {
    // One more than there are kernels, so that none of them is the last while they are asked.
    auto left = std::make_shared<std::atomic<int>>(1);
    const auto one_less = [left, call, user] {
      if (--*left == 0) call(user);
    };
    for (int entry = 0; entry < NACRE_ENTRY_COUNT; ++entry) {
      const BoundKernel* kernel = kernel_of(shader, static_cast<nacre_entry>(entry));
      if (kernel == nullptr) continue;
      ++*left;
      kernel->when_ended(one_less);
    }
    one_less();
    return nacre_status{NACRE_OK};
  });
}

nacre_status nacre_shader_wait(const nacre_shader* shader, nacre_report* report) {
  if (shader == nullptr) return NACRE_WRONG_ARGUMENTS;
  return guarded(report, [&] {
    Said said(report);
    const std::size_t before = said.diagnostics().error_count();
    bool is_compiled = true;
    for (int entry = 0; entry < NACRE_ENTRY_COUNT; ++entry) {
      const BoundKernel* kernel = kernel_of(shader, static_cast<nacre_entry>(entry));
      if (kernel == nullptr) continue;
      is_compiled = kernel->wait() && is_compiled;
      const Diagnostics of_kernel = kernel->diagnostics();
      for (const Diagnostic& one : of_kernel.all()) said.diagnostics().add(one);
    }
    return is_compiled && said.diagnostics().error_count() == before ? NACRE_OK : NACRE_FAILED;
  });
}

size_t nacre_shader_parameter_count(const nacre_shader* shader) {
  return shader != nullptr ? shader->data->parameters().size() : 0;
}

nacre_status nacre_shader_parameter(const nacre_shader* shader, size_t index,
                                    nacre_parameter* parameter) {
  if (index >= nacre_shader_parameter_count(shader)) return NACRE_WRONG_ARGUMENTS;
  const ShaderParameter& found = shader->data->parameters()[index];
  return give(parameter, {.size = 0,
                          .name = found.about.path.c_str(),
                          .type = type_name(found.about.type).data(),
                          .number_type = number_type(found.number),
                          .components = found.components,
                          .is_varying = found.is_varying ? 1 : 0,
                          .value = shader->data->block().data() + found.first,
                          .minimum = numbers(found.minimum),
                          .maximum = numbers(found.maximum),
                          .label = found.about.ui_name.c_str(),
                          .folder = found.about.ui_folder.c_str(),
                          .unit = found.about.unit.c_str(),
                          .document = found.about.doc.c_str()});
}

size_t nacre_shader_find_parameter(const nacre_shader* shader, const char* name) {
  if (name == nullptr) return SIZE_MAX;
  for (std::size_t i = 0; i < nacre_shader_parameter_count(shader); ++i) {
    if (shader->data->parameters()[i].about.path == name) return i;
  }
  return SIZE_MAX;
}
