#pragma once

#include <string_view>

namespace nacre::glsl {

/// What MaterialX's GLSL generator puts before every shader and its node
/// implementations therefore use without an include: libraries/stdlib/genglsl/
/// lib/mx_math.glsl of 1.39.5, the closure types of HwShaderGenerator, and the
/// tokens of GlslShaderGenerator. A text may define any of it again.
inline constexpr std::string_view prelude_text = R"(
#define M_PI 3.1415926535897932
#define M_PI_INV (1.0 / M_PI)
#define M_FLOAT_EPS 1e-8
#define mx_mod mod
#define mx_inverse inverse
#define mx_inversesqrt inversesqrt
#define mx_sin sin
#define mx_cos cos
#define mx_tan tan
#define mx_asin asin
#define mx_acos acos
#define mx_atan atan
#define mx_radians radians
#define mx_float_bits_to_int floatBitsToInt

float mx_square(float x) { return x * x; }
vec2 mx_square(vec2 x) { return x * x; }
vec3 mx_square(vec3 x) { return x * x; }

vec2 mx_matrix_mul(vec2 v, mat2 m) { return v * m; }
vec3 mx_matrix_mul(vec3 v, mat3 m) { return v * m; }
vec4 mx_matrix_mul(vec4 v, mat4 m) { return v * m; }
vec2 mx_matrix_mul(mat2 m, vec2 v) { return m * v; }
vec3 mx_matrix_mul(mat3 m, vec3 v) { return m * v; }
vec4 mx_matrix_mul(mat4 m, vec4 v) { return m * v; }
mat2 mx_matrix_mul(mat2 a, mat2 b) { return a * b; }
mat3 mx_matrix_mul(mat3 a, mat3 b) { return a * b; }
mat4 mx_matrix_mul(mat4 a, mat4 b) { return a * b; }

// IEC 61966-2-1
vec3 mx_srgb_encode(vec3 color)
{
    vec3 low = 12.92 * color;
    vec3 high = 1.055 * pow(max(color, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return mix(low, high, greaterThan(color, vec3(0.0031308)));
}

struct BSDF { vec3 response; vec3 throughput; };
struct VDF { vec3 response; vec3 throughput; };
#define EDF vec3
#define material surfaceshader
struct surfaceshader { vec3 color; vec3 transparency; };
struct volumeshader { vec3 color; vec3 transparency; };
struct displacementshader { vec3 offset; float scale; };
struct lightshader { vec3 intensity; vec3 direction; };
)";

/// The generator's tokens, "$name" in a text.
struct PreludeToken {
  std::string_view name;
  std::string_view text;
};
inline constexpr PreludeToken prelude_tokens[] = {
    {"closureDataConstructor", "ClosureData(closureType, L, V, N, P, occlusion)"},
    {"texSamplerSampler2D", "tex_sampler"},
    {"texSamplerSignature", "sampler2D tex_sampler"},
    // Images have uv (0, 0) at the lower left here, as MaterialX has it.
    {"fileTransformUv", "mx_transform_uv.glsl"},
};

}  // namespace nacre::glsl
