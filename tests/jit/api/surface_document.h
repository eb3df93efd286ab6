#pragma once

#include <string>

namespace nacre {

/// A material M whose roughness follows the texture coordinates, with that colour, or at its
/// default where it is empty.
inline std::string surface_document(const std::string& color, const std::string& metalness = "") {
  const auto input = [](const char* name, const char* type, const std::string& value) {
    return value.empty() ? std::string()
                         : "<input name=\"" + std::string(name) + "\" type=\"" + type +
                               "\" value=\"" + value + "\"/>";
  };
  return R"(<materialx version="1.39">
  <texcoord name="uv" type="vector2"/>
  <separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="uv"/>
  </separate2>
  <standard_surface name="S" type="surfaceshader">)" +
         input("base_color", "color3", color) + input("metalness", "float", metalness) + R"(
    <input name="specular_roughness" type="float" nodename="parts" output="outx"/>
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>)";
}

}  // namespace nacre
