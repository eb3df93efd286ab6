#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "jit/shading/system_parts.h"

namespace nacre {

/// Of what KernelRequest::with_begin names, that which is a value of the graph.
std::vector<std::string> values_of(const std::vector<std::string>& with_begin);

/// ShadingSystem::compile_variants.
std::vector<std::unique_ptr<MaterialKernels>> make_variants(const Document& document,
                                                            const std::string& material,
                                                            const SystemParts& parts,
                                                            std::span<const ShaderOptions> variants,
                                                            Diagnostics& diagnostics);

}  // namespace nacre
