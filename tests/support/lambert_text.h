#pragma once

#include <string>

namespace nacre {

/// Lambert's law with whatever is wrong with it: `f` of wi.z is its scattering function times the
/// cosine, the rest as it should be.
struct LambertText {
  std::string f = "color * wi.z / M_PI";
  std::string sample = "vec3(r * cos(turn), r * sin(turn), sqrt(1.0 - xi.x))";
  std::string pdf = "wi.z / M_PI";
  std::string albedo = "color";
  std::string more = {};  ///< Further functions.

  std::string text() const {
    return "vec3 own_evaluate(vec3 wo, vec3 wi, vec3 color) { return " + f + R"(; }
vec3 own_sample(vec3 wo, vec2 xi, vec3 color) {
  float r = sqrt(xi.x);
  float turn = 2.0 * M_PI * xi.y;
  return )" +
           sample + "; }\nfloat own_pdf(vec3 wo, vec3 wi, vec3 color) { return " + pdf +
           "; }\nvec3 own_albedo(vec3 wo, vec3 color) { return " + albedo + "; }\n" + more;
  }
};

}  // namespace nacre
