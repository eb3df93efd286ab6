#include <cstring>
#include <memory>

#include "jit/api/call.h"
#include "jit/api/handles.h"

using namespace nacre;
using namespace nacre::api;

namespace {

/// Null for what no instance has a value of.
const ShaderParameter* parameter_of(const nacre_instance* instance, std::size_t index) {
  if (instance == nullptr || index >= instance->data->parameters().size()) return nullptr;
  const ShaderParameter& parameter = instance->data->parameters()[index];
  return parameter.is_varying ? nullptr : &parameter;
}

}  // namespace

FittedByEntry nacre::api::fitted_of(const ShaderData& shader) {
  for (int entry = 0; entry < NACRE_ENTRY_COUNT; ++entry) {
    const BoundKernel* kernel = shader.kernel(static_cast<nacre_entry>(entry));
    if (kernel == nullptr || !kernel->is_fitted()) continue;
    return std::make_unique<FittedByEntry::element_type>();
  }
  return nullptr;
}

nacre_status nacre_instance_create(const nacre_shader* shader, nacre_instance** instance) {
  if (instance == nullptr) return NACRE_WRONG_ARGUMENTS;
  *instance = nullptr;
  if (shader == nullptr) return NACRE_WRONG_ARGUMENTS;
  return guarded([&] {
    *instance = new nacre_instance{shader->data, shader->data->block(), fitted_of(*shader->data)};
    return NACRE_OK;
  });
}

void nacre_instance_destroy(nacre_instance* instance) { delete instance; }

nacre_status nacre_instance_set(nacre_instance* instance, size_t index, const void* values) {
  const ShaderParameter* parameter = parameter_of(instance, index);
  if (parameter == nullptr || values == nullptr) return NACRE_WRONG_ARGUMENTS;
  std::memcpy(instance->block.data() + parameter->first, values,
              4 * static_cast<std::size_t>(parameter->components));
  return NACRE_OK;
}

nacre_status nacre_instance_get(const nacre_instance* instance, size_t index, void* values) {
  const ShaderParameter* parameter = parameter_of(instance, index);
  if (parameter == nullptr || values == nullptr) return NACRE_WRONG_ARGUMENTS;
  std::memcpy(values, instance->block.data() + parameter->first,
              4 * static_cast<std::size_t>(parameter->components));
  return NACRE_OK;
}
