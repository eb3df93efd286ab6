// What points of meshes have, and maps made of them.
#include <cmath>

#include "examples/bake/bake_filled.h"
#include "examples/bake_mesh/mesh_surface.h"
#include "tests/examples/bake/bake_fixture.h"
#include "tests/examples/bake_mesh/mesh_samples.h"

namespace nacre {
namespace {

using host::Mesh;
using host::MeshSurface;
using host::Vec2;
using host::Vec3;

class MeshBake : public Bake {
 protected:
  static std::unique_ptr<MeshSurface> surface_of(host::Scene scene, int rays = 16) {
    Diagnostics diagnostics;
    host::MeshRequest request;
    request.transport.rays = rays;
    auto surface = MeshSurface::make(std::move(scene), request, diagnostics);
    EXPECT_NE(surface, nullptr) << diagnostics.to_string();
    return surface;
  }

  /// Of these nodes, one of them named n.
  std::unique_ptr<const OutputKernel> kernel_on(MeshSurface& surface, const std::string& nodes,
                                                const std::string& type) {
    const std::string file =
        folder_.write("m.mtlx", "<materialx version=\"1.39\"><nodegraph name=\"G\">" + nodes +
                                    "<output name=\"o\" type=\"" + type +
                                    "\" nodename=\"n\"/></nodegraph></materialx>");
    Diagnostics diagnostics;
    ShaderOptions options;
    options.varying = surface.varying();
    const auto document = read_document(file, {}, diagnostics);
    auto kernel =
        document ? system_->compile_outputs(*document, {"G/o"}, options, diagnostics) : nullptr;
    EXPECT_NE(kernel, nullptr) << diagnostics.to_string();
    if (kernel) {
      EXPECT_TRUE(surface.prepare(kernel->kernel.program(), diagnostics));
    }
    return kernel;
  }

  static host::BakeSettings settings_of(const MeshSurface& surface, int width, int height,
                                        int count = 1) {
    host::BakeSettings settings;
    settings.width = width;
    settings.height = height;
    settings.surface = &surface;
    settings.sampling = {count, 0.01f};
    return settings;
  }

  /// With what is beside islands.
  static host::BakedRows filled(const OutputKernel& kernel, const host::BakeSettings& settings) {
    host::BakedRows all;
    const auto append = [&](host::BakedRows& rows) {
      return [&all, mine = rows] {
        all.planes.resize(mine.planes.size());
        for (std::size_t c = 0; c < mine.planes.size(); ++c) {
          all.planes[c].insert(all.planes[c].end(), mine.planes[c].begin(), mine.planes[c].end());
        }
        all.covered.insert(all.covered.end(), mine.covered.begin(), mine.covered.end());
        return true;
      };
    };
    EXPECT_EQ(host::bake_filled(kernel, 0, settings, 8, append), host::BakeResult::done);
    return all;
  }
};

TEST_F(MeshBake, TexelsHaveThePositionsAndFramesOfTheirMesh) {
  Mesh quad = host::make_quad("quad", {1, 2, 3}, {2, 0, 0}, {0, 0, -4});
  quad.position_object = quad.position;
  for (Vec3& p : quad.position_object) p = 0.5f * p;
  quad.object_to_world = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {}};
  const auto surface = surface_of(host::scene_of(quad));
  constexpr int width = 8, height = 4;
  struct Case {
    std::string category, space;
    Vec3 corner, along, across;  // What it is at uv (0, 0), and by how much it changes.
  };
  const std::vector<Case> cases = {
      {"position", "world", {1, 2, 3}, {2, 0, 0}, {0, 0, -4}},
      {"position", "object", {0.5f, 1, 1.5f}, {1, 0, 0}, {0, 0, -2}},
      {"normal", "world", {0, 1, 0}, {}, {}},
      {"normal", "object", {0, 1, 0}, {}, {}},
      {"tangent", "world", {1, 0, 0}, {}, {}},
      {"bitangent", "world", {0, 0, -1}, {}, {}},
  };
  for (const Case& each : cases) {
    const auto kernel = kernel_on(*surface,
                                  "<" + each.category +
                                      " name='n' type='vector3'><input "
                                      "name='space' type='string' value='" +
                                      each.space + "'/></" + each.category + ">",
                                  "vector3");
    ASSERT_NE(kernel, nullptr);
    const std::vector<float> texels =
        host::bake_image(*kernel, 0, settings_of(*surface, width, height));
    ASSERT_EQ(texels.size(), 3u * width * height);
    for (int i = 0; i < width * height; ++i) {
      const float u = (static_cast<float>(i % width) + 0.5f) / width;
      const float v = 1.0f - (static_cast<float>(i / width) + 0.5f) / height;
      const Vec3 right = each.corner + u * each.along + v * each.across;
      const float* texel = &texels[static_cast<std::size_t>(3 * i)];
      EXPECT_NEAR(texel[0], right.x, 1e-6f) << each.category << each.space;
      EXPECT_NEAR(texel[1], right.y, 1e-6f) << each.category << each.space;
      EXPECT_NEAR(texel[2], right.z, 1e-6f) << each.category << each.space;
    }
  }
}

TEST_F(MeshBake, PropertiesAndColoursAreTheVertices) {
  Mesh quad = host::make_quad("quad", {}, {1, 0, 0}, {0, 1, 0});
  quad.primvars.push_back({"wear", 1, {0, 1, 1, 0}});                            // u
  quad.primvars.push_back({"color0", 3, {0, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1, 1}});  // (0, v, 1)
  const auto surface = surface_of(host::scene_of(quad));
  const auto wear = kernel_on(*surface,
                              "<geompropvalue name='n' type='float'><input name='geomprop' "
                              "type='string' value='wear'/></geompropvalue>",
                              "float");
  const auto absent = kernel_on(*surface,
                                "<geompropvalue name='n' type='float'><input name='geomprop' "
                                "type='string' value='rust'/><input name='default' type='float' "
                                "value='0.25'/></geompropvalue>",
                                "float");
  const auto color = kernel_on(*surface, "<geomcolor name='n' type='color3'/>", "color3");
  ASSERT_TRUE(wear && absent && color);
  const host::BakeSettings settings = settings_of(*surface, 4, 4);
  const std::vector<float> wears = host::bake_image(*wear, 0, settings);
  const std::vector<float> colors = host::bake_image(*color, 0, settings);
  for (const float value : host::bake_image(*absent, 0, settings)) EXPECT_EQ(value, 0.25f);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_NEAR(wears[i], (static_cast<float>(i % 4) + 0.5f) / 4, 1e-6f);
    EXPECT_EQ(colors[3 * i], 0.0f);
    EXPECT_NEAR(colors[3 * i + 1], 1.0f - (static_cast<float>(i / 4) + 0.5f) / 4, 1e-6f);
    EXPECT_EQ(colors[3 * i + 2], 1.0f);
  }
}

/// From the texel to the next one on the same triangle, along x and y.
TEST_F(MeshBake, FootprintsAreTheChangeFromTexelToTexel) {
  constexpr int width = 256, height = 192;
  const auto surface = surface_of(host::scene_of(host::random_triangles(4, 5)));
  Program program;
  for (const char* name : {"P.x", "P.y", "P.z", "dPdx.x", "dPdx.y", "dPdx.z", "dPdy.x", "dPdy.y",
                           "dPdy.z", "uv0.x", "uv0.y", "duv0dx.x", "duv0dx.y", "duv0dy.y"}) {
    program.inputs.push_back({name, Scalar::f32});
  }
  const auto points = surface->points(settings_of(*surface, width, height), program);
  points->enter(0, height);
  const auto values = [&](const char* name, const host::TexelPoints& at) {
    std::vector<float> result;
    points->fill(name, at, result);
    return result;
  };
  int compared = 0;
  for (std::size_t texel = 0; texel < width * height; ++texel) {
    if (!points->covers(texel)) continue;
    const float x = static_cast<float>(texel % width), y = static_cast<float>(texel / width);
    host::TexelPoints at{{x + 0.25f, x + 0.75f, x + 0.25f},
                         {y + 0.25f, y + 0.25f, y + 0.75f},
                         0.5f,
                         {texel, texel, texel}};
    const auto inside = points->place(at);
    if (inside[0] == 0 || inside[1] == 0 || inside[2] == 0) continue;
    const std::vector<float> dx = values("dPdx.x", at);
    if (dx[0] != dx[1] || dx[0] != dx[2]) continue;  // Of several triangles.
    ++compared;
    for (const char axis : {'x', 'y', 'z'}) {
      const std::vector<float> p = values((std::string("P.") + axis).c_str(), at);
      EXPECT_NEAR(values((std::string("dPdx.") + axis).c_str(), at)[0], p[1] - p[0], 2e-6f);
      EXPECT_NEAR(values((std::string("dPdy.") + axis).c_str(), at)[0], p[2] - p[0], 2e-6f);
    }
    EXPECT_NEAR(values("duv0dx.x", at)[0], 0.5f / width, 1e-7f);
    EXPECT_NEAR(values("duv0dx.y", at)[0], 0.0f, 1e-7f);
    EXPECT_NEAR(values("duv0dy.y", at)[0], -0.5f / height, 1e-7f);
  }
  EXPECT_GT(compared, 50);
}

/// Samples of a texel that lie beside the triangle do not count: u of what is left of a diagonal.
TEST_F(MeshBake, SamplesBesideTheMeshDoNotCount) {
  Mesh mesh = host::make_quad("quad", {}, {1, 0, 0}, {0, 1, 0});
  mesh.triangles = {{{0, 1, 3}}};  // u + v < 1
  const auto surface = surface_of(host::scene_of(mesh));
  const auto kernel = kernel_on(*surface,
                                "<texcoord name='t' type='vector2'/><extract name='n' "
                                "type='float'><input name='in' type='vector2' nodename='t'/>"
                                "<input name='index' type='integer' value='0'/></extract>",
                                "float");
  ASSERT_NE(kernel, nullptr);
  for (const int count : {4096, 0}) {
    const std::vector<float> texels =
        host::bake_image(*kernel, 0, settings_of(*surface, 4, 4, count));
    for (int row = 0; row < 4; ++row) {
      // The texel that the diagonal cuts is half; the middle of its part is a third along it.
      const float right = (static_cast<float>(row) + 1.0f / 3.0f) / 4.0f;
      // Those on the diagonal, 1/64 of the texel's side each way, are of the triangle.
      EXPECT_NEAR(texels[static_cast<std::size_t>(5 * row)], right, count == 0 ? 1e-2f : 1e-3f);
      if (row == 3) continue;
      EXPECT_EQ(texels[static_cast<std::size_t>(5 * row + 1)], 0.0f);  // Not covered.
    }
  }
}

TEST_F(MeshBake, BitsDoNotDependOnThreads) {
  host::Scene scene = host::scene_of(host::make_sphere("ball", {0, 1, 0}, 1.0f, 12));
  scene.meshes.push_back(host::make_quad("floor", {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
  for (Vec2& uv : scene.meshes[1].uv) uv = {0.4f * uv.x + 0.1f, 0.3f * uv.y - 0.2f};  // Over it.
  const auto surface = surface_of(std::move(scene), 4);
  const auto kernel = kernel_on(
      *surface,
      "<geompropvalue name='a' type='vector3'><input name='geomprop' type='string' "
      "value='bentnormal'/></geompropvalue><geompropvalue name='c' type='float'><input "
      "name='geomprop' type='string' value='thickness'/></geompropvalue><fractal3d name='f' "
      "type='vector3'/><multiply name='m' type='vector3'><input name='in1' type='vector3' "
      "nodename='a'/><input name='in2' type='float' nodename='c'/></multiply><add name='n' "
      "type='vector3'><input name='in1' type='vector3' nodename='m'/><input name='in2' "
      "type='vector3' nodename='f'/></add>",
      "vector3");
  ASSERT_NE(kernel, nullptr);
  for (const int count : {1, 5, 0}) {
    host::BakeSettings settings = settings_of(*surface, 20, 37, count);
    settings.threads = 1;
    const host::BakedRows one = filled(*kernel, settings);
    for (const int threads : {2, 7}) {
      settings.threads = threads;
      EXPECT_EQ(filled(*kernel, settings).planes, one.planes) << threads << ' ' << count;
    }
  }
}

/// A mip level up, every texel with some of an island is what the islands are.
TEST_F(MeshBake, SeamsDoNotShowOneMipLevelUp) {
  const auto surface = surface_of(host::scene_of(host::random_triangles(5, 11, 0.8f)));
  // The same everywhere, though a kernel is needed for it: |N|.
  const auto kernel = kernel_on(*surface,
                                "<normal name='w' type='vector3'/><magnitude name='n' "
                                "type='float'><input name='in' type='vector3' nodename='w'/>"
                                "</magnitude>",
                                "float");
  ASSERT_NE(kernel, nullptr);
  for (const host::Dilation dilation :
       {host::Dilation{1, false}, {16, false}, {0, true}, {4, true}}) {
    constexpr std::size_t size = 64;
    host::BakeSettings settings = settings_of(*surface, size, size);
    settings.dilation = dilation;
    const host::BakedRows map = filled(*kernel, settings);
    std::size_t borders = 0, empty = 0;
    for (std::size_t y = 0; y < size; y += 2) {
      for (std::size_t x = 0; x < size; x += 2) {
        float sum = 0.0f;
        int covered = 0;
        for (const std::size_t i :
             {y * size + x, y * size + x + 1, (y + 1) * size + x, (y + 1) * size + x + 1}) {
          sum += map.planes[0][i];
          covered += map.covered[i];
        }
        if (covered > 0 || dilation.fills) {
          EXPECT_NEAR(0.25f * sum, 1.0f, 1e-6f) << x << ' ' << y;
        }
        borders += covered > 0 && covered < 4 ? 1 : 0;
        empty += covered == 0 ? 1 : 0;
      }
    }
    EXPECT_GT(borders, 30u);
    EXPECT_GT(empty, 100u);
  }
}

}  // namespace
}  // namespace nacre
