#include "examples/tool/lobe_laws.h"
#include "jit/api/handles.h"

namespace nacre::tool {

nacre_shader* public_handle(std::unique_ptr<MaterialKernels> kernels) {
  return new nacre_shader{std::make_shared<const api::ShaderData>(std::move(kernels))};
}

}  // namespace nacre::tool
