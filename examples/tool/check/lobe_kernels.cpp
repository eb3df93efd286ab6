#include "examples/tool/check/lobe_kernels.h"

#include "jit/api/handles.h"

namespace nacre::tool {

LobeFindings try_lobes(std::unique_ptr<MaterialKernels> kernels, const LobeEffort& effort) {
  const bool has_closure = kernels->sample && kernels->evaluate && kernels->albedo;
  if (!has_closure) return {};
  // try_lobes() destroys it.
  auto* const handle =
      new nacre_shader{std::make_shared<const api::ShaderData>(std::move(kernels))};
  return try_lobes(handle, effort);
}

}  // namespace nacre::tool
