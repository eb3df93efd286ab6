// Meshes that meshopt and Draco packed are those that were packed.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>

#include "tests/examples/render/card_fixture.h"

namespace nacre::host {
namespace {

class Packed : public Card {};

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

std::string extended(std::string text, std::string_view from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// The card whose positions are packed behind its data, in so many bytes.
std::string packed_positions(std::size_t bytes, const std::string& form) {
  const std::string text =
      spoiled_card("\"byteLength\": 204", "\"byteLength\": " + std::to_string(204 + bytes));
  return extended(text, R"("byteOffset": 0, "byteLength": 48})",
                  R"("byteLength": 48, "extensions": {"EXT_meshopt_compression": {"buffer": 0,
                     "byteOffset": 204, "byteLength": )" +
                      std::to_string(bytes) + ", " + form + "}}}");
}

TEST_F(Packed, ByMeshopt) {
  const Scene plain = load(std::string(card_json), card_data());
  ASSERT_EQ(plain.meshes.size(), 1u) << diagnostics_.to_string();
  const std::string data = card_data();
  std::string packed(meshopt_encodeVertexBufferBound(4, 12), '\0');
  packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                           packed.size(), data.data(), 4, 12));
  const std::string form = R"("byteStride": 12, "count": 4, "mode": "ATTRIBUTES")";
  // In place of what is packed there is nothing that would do.
  std::string spoiled = data;
  std::fill_n(spoiled.begin(), 48, '\0');
  const Scene scene = load(packed_positions(packed.size(), form), spoiled + packed);
  ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics_.to_string();
  EXPECT_TRUE(std::ranges::equal(scene.meshes[0].position, plain.meshes[0].position, same));
  EXPECT_TRUE(load(packed_positions(packed.size(), form), spoiled + std::string(packed.size(), 'x'))
                  .meshes.empty());
  EXPECT_EQ(first(), "bad-gltf bufferViews[0].extensions.EXT_meshopt_compression");
  for (const char* wrong : {R"("byteStride": 6, "count": 4, "mode": "ATTRIBUTES")",
                            R"("byteStride": 12, "count": 4, "mode": "TRIANGLES")",
                            R"("byteStride": 12, "count": 4, "mode": "ATTRIBUTES", "filter": "X")",
                            R"("byteStride": 12, "count": 99999999999, "mode": "ATTRIBUTES")"}) {
    EXPECT_TRUE(load(packed_positions(packed.size(), wrong), spoiled + packed).meshes.empty());
    EXPECT_EQ(diagnostics_.all().front().where.path,
              "bufferViews[0].extensions.EXT_meshopt_compression")
        << wrong;
  }
}

TEST_F(Packed, ByDraco) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const float a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {1, 1, 0}, d[3] = {0, 1, 0.5f};
  builder.SetAttributeValuesForFace(position, draco::FaceIndex(0), a, b, c);
  builder.SetAttributeValuesForFace(position, draco::FaceIndex(1), a, c, d);
  const auto mesh = builder.Finalize();
  draco::EncoderBuffer buffer;
  draco::Encoder encoder;  // Without quantization.
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  const std::string packed(buffer.data(), buffer.size());
  std::string text =
      spoiled_card(R"("POSITION": 0, "TEXCOORD_0": 1, "NORMAL": 3)", "\"POSITION\": 0");
  text = extended(text, "\"indices\": 2",
                  R"("indices": 2, "extensions": {"KHR_draco_mesh_compression":
                     {"bufferView": 5, "attributes": {"POSITION": 0}}})");
  text = extended(text, "\"byteLength\": 204",
                  "\"byteLength\": " + std::to_string(204 + packed.size()));
  text = extended(text, "],\n  \"accessors\"",
                  ", {\"buffer\": 0, \"byteOffset\": 204, \"byteLength\": " +
                      std::to_string(packed.size()) + "}],\n  \"accessors\"");
  text = extended(text, R"({"bufferView": 0, "componentType": 5126)", R"({"componentType": 5126)");
  text = extended(text, R"({"bufferView": 2, "componentType": 5123)", R"({"componentType": 5123)");
  const Scene scene = load(text, card_data() + packed);
  ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics_.to_string();
  // Draco chooses the order.
  const std::vector<Vec3>& found = scene.meshes[0].position;
  ASSERT_EQ(found.size(), 4u);
  for (const float* const x : {a, b, c, d}) {
    const Vec3 corner = {x[0], x[1], x[2]};
    EXPECT_EQ(std::ranges::count_if(found, [&](Vec3 v) { return same(v, corner); }), 1);
  }
  EXPECT_TRUE(load(text, card_data() + std::string(packed.size(), 'x')).meshes.empty());
  EXPECT_EQ(first(), "bad-gltf meshes[0].primitives[0].extensions.KHR_draco_mesh_compression");
  // Sequential, of 2^34 faces: refused before there is memory for them.
  std::string huge = "DRACO" + std::string("\2\2\1\0\0\0\x80\x80\x80\x80\x40\4", 12);
  ASSERT_LE(huge.size(), packed.size());
  huge.resize(packed.size());
  EXPECT_TRUE(load(text, card_data() + huge).meshes.empty());
  EXPECT_EQ(first(),
            "scene-too-large meshes[0].primitives[0].extensions.KHR_draco_mesh_compression");
}

}  // namespace
}  // namespace nacre::host
