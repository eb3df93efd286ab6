#pragma once

#include <string>
#include <string_view>

namespace nacre {

/// Elements of a document, as hosts write them.
/// @{
inline std::string element(std::string_view category, std::string_view type, std::string_view name,
                           std::string_view inputs) {
  std::string text = "<";
  text.append(category).append(" name=\"").append(name).append("\" type=\"").append(type);
  text.append("\">").append(inputs).append("</").append(category).append(">\n");
  return text;
}
inline std::string value_of(std::string_view name, std::string_view type, std::string_view value) {
  std::string text = "<input name=\"";
  text.append(name).append("\" type=\"").append(type).append("\" value=\"").append(value);
  return text.append("\"/>");
}
inline std::string from(std::string_view name, std::string_view type, std::string_view node) {
  std::string text = "<input name=\"";
  text.append(name).append("\" type=\"").append(type).append("\" nodename=\"").append(node);
  return text.append("\"/>");
}
/// @}

/// The document whose material M has the surface shader S, or the BSDF b where `nodes` has no S.
inline std::string material_of(const std::string& nodes) {
  std::string text = "<materialx version=\"1.39\">\n" + nodes;
  if (nodes.find("name=\"S\"") == std::string::npos) {
    text += element("surface", "surfaceshader", "S", from("bsdf", "BSDF", "b"));
  }
  text += element("surfacematerial", "material", "M", from("surfaceshader", "surfaceshader", "S"));
  return text + "</materialx>\n";
}

/// `text` with `value` wherever it says "{}".
inline std::string filled(std::string text, std::string_view value) {
  for (std::size_t at = 0; (at = text.find("{}", at)) != std::string::npos; at += value.size()) {
    text.replace(at, 2, value);
  }
  return text;
}

}  // namespace nacre
