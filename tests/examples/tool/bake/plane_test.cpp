// What a bake on the plane cannot know is said: the node and the attribute that it reads.
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

class Plane : public Tool {
 protected:
  /// Bakes the one output of a graph of these nodes; `out` is what it shows.
  int bake(const std::string& nodes, const std::string& type = "vector3") {
    write("a.mtlx", "<materialx version=\"1.39\"><nodegraph name=\"G\">\n" + nodes +
                        "<output name=\"o\" type=\"" + type +
                        "\" nodename=\"n\"/></nodegraph></materialx>");
    return run("bake " + file("a.mtlx") + " --no-cache --size 4 --out " + file("out"));
  }
};

TEST_F(Plane, NamesTheNodeAndTheAttribute) {
  struct Reader {
    std::string category, type, inputs, attribute;
  };
  const std::vector<Reader> readers = {
      {"position", "vector3", "", "the position read"},
      {"position", "vector3", "<input name='space' type='string' value='world'/>",
       "the position read"},
      {"normal", "vector3", "", "the normal read"},
      {"tangent", "vector3", "", "the tangent read"},
      {"bitangent", "vector3", "", "the bitangent read"},
      {"viewdirection", "vector3", "", "the view direction read"},
      {"geomcolor", "color3", "<input name='index' type='integer' value='2'/>",
       "the vertex colour 2 read"},
      {"geompropvalue", "float", "<input name='geomprop' type='string' value='wear'/>",
       "the geometric property 'wear' read"}};
  for (const Reader& reader : readers) {
    const std::string node = "<" + reader.category + " name=\"n\" type=\"" + reader.type + "\">" +
                             reader.inputs + "</" + reader.category + ">";
    EXPECT_EQ(bake(node, reader.type), 0) << errors_;
    EXPECT_TRUE(says("a.mtlx:2:")) << errors_;
    EXPECT_TRUE(says("warning: " + reader.attribute)) << reader.category << errors_;
    EXPECT_TRUE(says("[plane-geometry] (G/n)")) << errors_;
  }
}

TEST_F(Plane, NamesWhoReadsAnAttributeByDefault) {
  EXPECT_EQ(bake("<fractal3d name=\"n\" type=\"vector3\"/>"), 0);
  EXPECT_TRUE(says("the position read")) << errors_;
  EXPECT_TRUE(says("a.mtlx:2:")) << errors_;
}

TEST_F(Plane, IsSilentWhereUvIsAllThereIs) {
  EXPECT_EQ(bake("<noise2d name=\"n\" type=\"vector3\"/>"), 0);
  EXPECT_EQ(errors_, "");
  // What is read and does not count is not read.
  EXPECT_EQ(bake("<position name=\"p\" type=\"vector3\"/><noise2d name=\"q\" type=\"vector3\"/>"
                 "<mix name=\"n\" type=\"vector3\"><input name=\"fg\" type=\"vector3\" "
                 "nodename=\"p\"/><input name=\"bg\" type=\"vector3\" nodename=\"q\"/>"
                 "<input name=\"mix\" type=\"float\" value=\"0\"/></mix>"),
            0);
  EXPECT_EQ(errors_, "");
}

TEST_F(Plane, DoesNotKnowHowSetsOfCoordinatesRelate) {
  const auto texcoord = [](const std::string& name, int set) {
    return "<texcoord name=\"" + name + "\" type=\"vector2\"><input name=\"index\" " +
           "type=\"integer\" value=\"" + std::to_string(set) + "\"/></texcoord>";
  };
  EXPECT_EQ(bake(texcoord("n", 1), "vector2"), 0);
  EXPECT_EQ(errors_, "");
  EXPECT_EQ(bake(texcoord("a", 0) + texcoord("b", 1) +
                     "<add name=\"n\" type=\"vector2\"><input name=\"in1\" type=\"vector2\" "
                     "nodename=\"a\"/><input name=\"in2\" type=\"vector2\" nodename=\"b\"/></add>",
                 "vector2"),
            0);
  EXPECT_TRUE(says("texture coordinate set 1")) << errors_;
}

// A direction in the surface's frame is what a normal map is; a position is not.
TEST_F(Plane, DocumentsMayReadTheFrameForDirectionsOnly) {
  const auto document = [&](const std::string& input, const std::string& category) {
    write("a.mtlx",
          "<materialx version=\"1.39\"><nodegraph name=\"G\">"
          "<" +
              category + " name=\"n\" type=\"vector3\">" +
              "<input name=\"space\" type=\"string\" value=\"world\"/></" + category + ">" +
              "<noise2d name=\"q\" type=\"vector3\"/>"
              "<add name=\"s\" type=\"vector3\"><input name=\"in1\" type=\"vector3\" "
              "nodename=\"n\"/><input name=\"in2\" type=\"vector3\" nodename=\"q\"/></add>"
              "<output name=\"o\" type=\"vector3\" nodename=\"s\"/></nodegraph>"
              "<standard_surface name=\"S\" type=\"surfaceshader\"><input name=\"" +
              input +
              "\" type=\"vector3\" nodegraph=\"G\" output=\"o\"/></standard_surface>"
              "<surfacematerial name=\"M\" type=\"material\"><input name=\"surfaceshader\" "
              "type=\"surfaceshader\" nodename=\"S\"/></surfacematerial></materialx>");
    return run("bake " + file("a.mtlx") + " --no-cache --size 4 --document " + file("b.mtlx"));
  };
  EXPECT_EQ(document("normal", "normal"), 0) << errors_;
  EXPECT_EQ(errors_, "");
  EXPECT_EQ(document("normal", "position"), 0) << errors_;
  EXPECT_TRUE(says("[plane-geometry] (G/n)")) << errors_;
}

}  // namespace
}  // namespace nacre
