#pragma once

#include <cstdint>
#include <vector>

#include "examples/render/batch_buffer.h"
#include "examples/render/light_shader.h"
#include "examples/render/render_context.h"

namespace nacre::host {

/// How bright one side of each triangle of a mesh is: the luminance of its radiance, the mean over
/// four points and four directions within 60 degrees of its normal. Only a guess of what kernels
/// may give, for they are asked nowhere else. Empty where that side does not emit.
std::vector<float> probe_side(const RenderContext& context, std::uint32_t mesh, bool back,
                              BatchBuffer& buffer);

/// What a light that no ray meets sends to the scene: the luminance of its irradiance across the
/// direction to it, the mean over points all over the box of the scene.
float probe_light(const RenderContext& context, const LightShader& light, BatchBuffer& buffer);

}  // namespace nacre::host
