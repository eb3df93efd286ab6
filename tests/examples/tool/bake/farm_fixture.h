#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "examples/common/image_writer.h"
#include "runtime/digest.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {

/// A material of three tiles: an image, a pattern of an include, what has no inputs, and what has,
/// but is the same everywhere.
class Farm : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    write_include(0.5);
    write_image(0.25);
    write("a.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709"
        xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="lib.mtlx"/>
      <geominfo name="i" geom="/"><geomprop name="udimset" type="stringarray"
        value="1001,1002,1011"/></geominfo>
      <nodegraph name="G">
        <image name="i" type="color3"><input name="file" type="filename" value="t.png"/></image>
        <constant name="c" type="float"><input name="value" type="float" value="0.25"/></constant>
        <texcoord name="t" type="vector2"/>
        <extract name="u" type="float"><input name="in" type="vector2" nodename="t"/></extract>
        <min name="z" type="float"><input name="in1" type="float" nodename="u"/>
          <input name="in2" type="float" value="0"/></min>
        <output name="image" type="color3" nodename="i"/>
        <output name="const" type="float" nodename="c"/>
        <output name="zero" type="float" nodename="z"/>
      </nodegraph>
      <standard_surface name="S" type="surfaceshader">
        <input name="base_color" type="color3" nodegraph="G" output="image"/>
        <input name="specular_color" type="color3" nodegraph="H" output="o"/>
        <input name="base" type="float" nodegraph="G" output="const"/>
        <input name="metalness" type="float" nodegraph="G" output="zero"/>
      </standard_surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/>
      </surfacematerial></materialx>)");
  }

  void write_include(double pivot) const {
    write("lib.mtlx",
          R"(<materialx version="1.39"><nodegraph name="H"><noise2d name="n" type="color3">
               <input name="pivot" type="float" value=")" +
              std::to_string(pivot) + R"("/></noise2d>
               <output name="o" type="color3" nodename="n"/></nodegraph></materialx>)");
  }

  /// Black but for one texel, so that it is not the same everywhere.
  void write_image(float value) const {
    const host::ImageHeader header{.kind = host::ImageKind::png,
                                   .width = 4,
                                   .height = 4,
                                   .channels = {"R", "G", "B"},
                                   .colorspace = "Linear"};
    std::vector<float> plane(16);
    plane[5] = value;
    std::string problem;
    const auto image = host::open_image(file("t.png"), header, problem);
    ASSERT_NE(image, nullptr) << problem;
    EXPECT_EQ(host::write_planes(*image, header, std::vector(3, plane)), "");
  }

  int bake(const std::string& arguments) {
    return run("bake " + file("a.mtlx") + " --udim auto --cache " + file("cache") + " " +
               (arguments.find("--size") == std::string::npos ? "--size 8 " : "") + arguments);
  }
  int bake_document(const std::string& folder, const std::string& arguments = "") {
    return bake("--document " + file(folder + "/b.mtlx") + " " + arguments);
  }

  /// Digests of the files in a folder that are no manifests.
  std::map<std::string, std::string> baked(const std::string& folder) const {
    std::map<std::string, std::string> all;
    for (const std::string& name : names_in(file(folder))) {
      if (name.ends_with(".json")) continue;
      all[name] = to_hex(sha256(text_of(file(folder + "/" + name))));
    }
    return all;
  }

  nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(text_of(file(name)));
  }
};

}  // namespace nacre
