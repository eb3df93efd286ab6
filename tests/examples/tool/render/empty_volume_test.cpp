// A volume of nothing is empty space, whatever says so.
#include "tests/examples/tool/render/image_layers.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

std::string document(const std::string& text) {
  return R"(<?xml version="1.0"?><materialx version="1.39">)" + text + "</materialx>";
}

std::string input(const std::string& name, const std::string& type, const std::string& value) {
  return "<input name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}
std::string linked(const std::string& name, const std::string& type, const std::string& node) {
  return "<input name=\"" + name + "\" type=\"" + type + "\" nodename=\"" + node + "\"/>";
}
std::string coefficients(const std::string& name, const std::string& value) {
  return input(name, "vector3", value);
}

/// A material that is a volume of these inputs, which those nodes are for.
std::string volume(const std::string& nodes, const std::string& inputs) {
  return document(nodes + R"(<volume name="S" type="volumeshader">)" + inputs +
                  R"(</volume><volumematerial name="M" type="material">)" +
                  linked("volumeshader", "volumeshader", "S") + "</volumematerial>");
}
std::string of_vdf(const std::string& nodes, const std::string& category,
                   const std::string& inputs) {
  return volume(
      nodes + "<" + category + R"( name="v" type="VDF">)" + inputs + "</" + category + ">",
      linked("vdf", "VDF", "v"));
}
/// Absorbs what a node makes of the place and three numbers.
std::string of_place(const std::string& category, const std::string& numbers) {
  return of_vdf(R"(<position name="p" type="vector3"/><)" + category +
                    R"( name="d" type="vector3">)" + linked("in1", "vector3", "p") +
                    coefficients("in2", numbers) + "</" + category + ">",
                "absorption_vdf", linked("absorption", "vector3", "d"));
}

struct Row {
  const char* name;
  std::string document;
  bool is_known;  ///< Before the first ray: a warning says so.
};

std::vector<Row> rows() {
  return {
      {"no vdf", volume("", ""), true},
      {"defaults", of_vdf("", "absorption_vdf", ""), true},
      {"zeros",
       of_vdf("", "anisotropic_vdf",
              coefficients("absorption", "0, 0, 0") + coefficients("scattering", "0, 0, 0") +
                  input("anisotropy", "float", "0.5")),
       true},
      {"below zero", of_vdf("", "absorption_vdf", coefficients("absorption", "-1, -2, -1e30")),
       true},
      {"weight zero",
       volume(R"(<absorption_vdf name="a" type="VDF">)" + coefficients("absorption", "1, 1, 1") +
                  R"(</absorption_vdf><multiply name="v" type="VDF">)" + linked("in1", "VDF", "a") +
                  input("in2", "float", "0") + "</multiply>",
              linked("vdf", "VDF", "v")),
       true},
      {"dark edf",
       volume(R"(<uniform_edf name="e" type="EDF">)" + input("color", "color3", "0, 0, 0") +
                  "</uniform_edf>",
              linked("edf", "EDF", "e")),
       true},
      {"density times zero", of_place("multiply", "0, 0, 0"), true},
      {"zero at each place", of_place("min", "-1e9, -1e9, -1e9"), false},
      {"a free path without end", of_place("divide", "3e38, 3e38, 3e38"), false},
      {"no number", of_place("divide", "0, 0, 0"), false},
  };
}

class EmptyVolume : public Tool {
 protected:
  Layers render(const std::string& document) {
    write("a.mtlx", document);
    const std::string command = "render --no-cache --material M --max-depth 3 --spp 2 --size 12 ";
    EXPECT_EQ(run(command + file("a.mtlx") + " --out " + file("a.exr")), 0) << errors_;
    return layers_of(file("a.exr"));
  }
};

TEST_F(EmptyVolume, LooksAsWhatLetsAllLightPass) {
  const Layers nothing = render(
      document(R"(<surface name="S" type="surfaceshader">)" + input("opacity", "float", "0") +
               R"(</surface><surfacematerial name="M" type="material">)" +
               linked("surfaceshader", "surfaceshader", "S") + "</surfacematerial>"));
  const Layers smoke = render(of_vdf("", "absorption_vdf", coefficients("absorption", "1, 1, 1")));
  ASSERT_EQ(nothing.planes.size(), 3u);
  EXPECT_NE(smoke.planes, nothing.planes);
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.name);
    EXPECT_EQ(render(row.document).planes, nothing.planes);
    EXPECT_EQ(says("[empty-volume]"), row.is_known) << errors_;
  }
}

}  // namespace
}  // namespace nacre
