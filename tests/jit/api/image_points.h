#pragma once

#include <array>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

namespace nacre {

using Color = std::array<float, 3>;

/// A document whose output "out" is the texel of an image at the point's texture coordinates.
inline Document image_document(const std::string& file, const std::string& name = "image.mtlx",
                               const std::string& filter = "closest") {
  return Document::parse(
      R"(<materialx version="1.39"><image name="i" type="color3">
           <input name="file" type="filename" value=")" +
          file + R"("/><input name="filtertype" type="string" value=")" + filter + R"("/></image>
         <output name="out" type="color3" nodename="i"/></materialx>)",
      name);
}

/// The output "out" at points with these u, v being 1/2.
inline std::vector<Color> colors_at(const Shader& shader, const std::vector<float>& u) {
  Binder binder;
  binder.array("uv0.x", {0, 0, sizeof(float)});
  binder.constant("uv0.y", {0.5f});
  for (const char* change : {"duv0dx", "duv0dy"}) binder.constant(change, {0, 0});
  binder.array("out", {1, 0, sizeof(Color)});
  const Binding binding(binder, shader);
  std::vector<float> places = u;
  std::vector<Color> colors(u.size());
  Batch batch;
  batch.count = u.size();
  binding.run(NACRE_OUTPUTS, std::vector<void*>{places.data(), colors.data()}, batch);
  return colors;
}

inline constexpr Color red{1, 0, 0};
inline constexpr Color green{0, 1, 0};
inline constexpr Color blue{0, 0, 1};

}  // namespace nacre
