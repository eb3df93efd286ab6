#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

bool reads(const Program& program, const std::string& channel) {
  return std::any_of(program.inputs.begin(), program.inputs.end(),
                     [&](const Channel& c) { return c.name == channel; });
}

TEST(Geometry, ChannelsFollowSpaceAndIndex) {
  const NodeUnderTest world{"normal", {{"space", Type::string, "world"}}, {{"out", Type::vector3}}};
  EXPECT_TRUE(reads(node_program(world), "N.x"));
  const NodeUnderTest model{
      "position", {{"space", Type::string, "model"}}, {{"out", Type::vector3}}};
  EXPECT_TRUE(reads(node_program(model), "Po.z"));
}

TEST(Geometry, AnUnknownPropertyIsItsDefault) {
  const NodeUnderTest node{"geompropvalue", {{"geomprop", Type::string, "wetness"}, {"default"}}};
  const Program program = node_program(node);
  EXPECT_TRUE(reads(program, "geomprop.wetness.x"));
  const Columns columns{{"default", {0.25f}}, {"geomprop.wetness.x", {0.75f}}};
  EXPECT_EQ(run_node(node, columns).at("out")[0], 0.25);
  Program present = program;
  for (ParameterSlot& slot : present.parameters) {
    if (slot.name == "geomprop.wetness") slot.value = 1;
  }
  EXPECT_EQ(run_double(*make_reference(present), columns).at("out")[0], 0.75);
}

/// Object to world: turned by 90 degrees about z, doubled along x first, moved.
Program with_transform(Program program) {
  const float to_world[16] = {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  const float to_object[16] = {0, -1, 0, 0, 0.5f, 0, 0, 0, 0, 0, 1, 0, -3, 5, -7, 1};
  for (ParameterSlot& slot : program.parameters) {
    const std::size_t dot = slot.name.rfind('.');
    const auto i = static_cast<std::size_t>(std::stoi(slot.name.substr(dot + 1)));
    const bool forward = slot.name.substr(0, dot) == "object_to_world";
    slot.value = std::bit_cast<std::uint32_t>(forward ? to_world[i] : to_object[i]);
  }
  return program;
}

std::vector<double> transformed(const std::string& category, const std::string& from,
                                const std::string& to, const std::vector<float>& v) {
  const NodeUnderTest node{
      category,
      {{"in", Type::vector3}, {"fromspace", Type::string, from}, {"tospace", Type::string, to}},
      {{"out", Type::vector3}}};
  const auto kernel = make_reference(with_transform(node_program(node)));
  const DoubleColumns out =
      run_double(*kernel, {{"in.x", {v[0]}}, {"in.y", {v[1]}}, {"in.z", {v[2]}}});
  return {out.at("out.x")[0], out.at("out.y")[0], out.at("out.z")[0]};
}

TEST(Geometry, PointsMoveVectorsTurn) {
  EXPECT_EQ(transformed("transformpoint", "object", "world", {1, 1, 1}),
            (std::vector<double>{4, 8, 8}));
  EXPECT_EQ(transformed("transformvector", "model", "world", {1, 1, 1}),
            (std::vector<double>{-1, 2, 1}));
  EXPECT_EQ(transformed("transformpoint", "world", "object", {4, 8, 8}),
            (std::vector<double>{1, 1, 1}));
}

TEST(Geometry, NormalsStayPerpendicularToTransformedSurfaces) {
  const std::vector<float> tangent{1, -1, 0};
  const std::vector<double> n = transformed("transformnormal", "object", "world", {1, 1, 0});
  const std::vector<double> t = transformed("transformvector", "object", "world", tangent);
  EXPECT_NEAR(n[0] * t[0] + n[1] * t[1] + n[2] * t[2], 0.0, 1e-12);
  EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1.0, 1e-12);
}

TEST(Geometry, NothingChangesBetweenEqualEmptyAndUnknownSpaces) {
  for (const auto& [from, to] : {std::pair{"", ""},
                                 {"world", "world"},
                                 {"object", "model"},
                                 {"", "world"},
                                 {"world", "shader"}}) {
    EXPECT_EQ(transformed("transformnormal", from, to, {2, 0, 0}), (std::vector<double>{2, 0, 0}));
    EXPECT_EQ(transformed("transformpoint", from, to, {2, 3, 4}), (std::vector<double>{2, 3, 4}));
  }
}

TEST(Geometry, ViewDirectionPointsAtTheSurface) {
  const NodeUnderTest node{
      "viewdirection", {{"space", Type::string, "world"}}, {{"out", Type::vector3}}};
  EXPECT_EQ(run_node(node, {{"wo.z", {1.0f}}}).at("out.z")[0], -1.0);
}

TEST(Application, FrameIsOneAndTimeZeroUntilTheHostSays) {
  EXPECT_EQ(run_node({"frame", {}}, {}).at("out")[0], 1.0);
  EXPECT_EQ(run_node({"time", {{"fps"}}}, {{"fps", {24.0f}}}).at("out")[0], 0.0);
}

TEST(Organization, DotPassesTexts) {
  Recorder recorder;
  const NodeUnderTest node{"dot", {{"in", Type::filename, "a/b.png"}}, {{"out", Type::filename}}};
  EXPECT_EQ(record_node(recorder, node).front().value.text, "a/b.png");
}

}  // namespace
}  // namespace nacre
