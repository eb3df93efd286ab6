// A path tracer on a page: spheres on a floor under a sky, each of the first material of a
// MaterialX document; the last document is the floor's.
//
//   surface OUT.ppm SAMPLES DOCUMENT.mtlx...
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nacre/nacre.hpp>
#include <random>

constexpr int width = 480, height = 270, most_bounces = 6;
constexpr std::size_t pixels = std::size_t(width) * height;
constexpr std::uint32_t nothing = ~0u;
struct Vec {
  float x = 0, y = 0, z = 0;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator*(Vec a, float b) { return {a.x * b, a.y * b, a.z * b}; }
Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec unit(Vec a) { return a * (1 / std::sqrt(dot(a, a))); }

/// A path under way, with what kernels read and store of its point; binder() says where.
struct Path {
  Vec P, N, T, B, wo, u, wi, weight, emission;
  float uv[2] = {0, 0};
  std::int32_t flags = 0;
  Vec from, direction, throughput{1, 1, 1};
  std::size_t pixel = 0;
};

/// Finds what a path meets and fills in its point: the number of the material, or `nothing`.
std::uint32_t trace(Path& path, std::uint32_t spheres) {
  const Vec o = path.from, d = path.direction;
  float nearest = d.y < -0.01f ? -o.y / d.y : 1e30f;
  std::uint32_t found = nearest < 50 ? spheres : nothing;
  const auto centre = [&](std::uint32_t i) {
    return 2.2f * (float(i) - 0.5f * float(spheres - 1));
  };
  for (std::uint32_t i = 0; i < spheres; ++i) {
    const Vec c = o + Vec{-centre(i), -1, 0};
    const float b = dot(c, d), inside = b * b - dot(c, c) + 1;
    for (const float side : {-1.0f, 1.0f}) {
      const float t = -b + side * std::sqrt(std::max(inside, 0.0f));
      if (inside > 0 && t > 1e-3f && t < nearest) nearest = t, found = i;
    }
  }
  if (found == nothing) return nothing;
  path.P = o + d * nearest, path.wo = d * -1;
  if (found == spheres) {
    path.N = {0, 1, 0}, path.T = {1, 0, 0};
    path.uv[0] = path.P.x / 4, path.uv[1] = -path.P.z / 4;
  } else {
    path.N = unit(path.P + Vec{-centre(found), -1, 0});
    path.T = unit({path.N.z, 0, 1e-6f - path.N.x});
    path.uv[0] = 0.5f + std::atan2(path.N.x, path.N.z) / 6.2831853f;
    path.uv[1] = 0.5f + std::asin(std::clamp(path.N.y, -1.0f, 1.0f)) / 3.1415927f;
  }
  path.B = cross(path.N, path.T);
  return found;
}

/// Array 0 is the paths, array 1 the state that kernels keep of them. Footprints are points.
nacre::Binder binder() {
  nacre::Binder made;
  const auto bind = [&](std::initializer_list<const char*> names, std::size_t offset) {
    for (const char* name : names) made.array(name, {0, std::ptrdiff_t(offset), sizeof(Path)});
  };
  bind({"P", "Po"}, offsetof(Path, P)), bind({"N", "No", "Ng"}, offsetof(Path, N));
  bind({"T", "To"}, offsetof(Path, T)), bind({"B", "Bo"}, offsetof(Path, B));
  bind({"wo"}, offsetof(Path, wo)), bind({"uv0"}, offsetof(Path, uv));
  bind({"u"}, offsetof(Path, u)), bind({"wi"}, offsetof(Path, wi));
  bind({"weight"}, offsetof(Path, weight)), bind({"flags"}, offsetof(Path, flags));
  bind({"emission"}, offsetof(Path, emission));
  for (const char* change : {"dPdx", "dPdy", "dPodx", "dPody", "duv0dx", "duv0dy"}) {
    made.constant(change, {0, 0, 0});
  }
  return std::move(made.array("state", {1, 0, 4, std::ptrdiff_t(4 * pixels)}));
}

int main(int argc, char** argv) try {
  if (argc < 5) return std::fprintf(stderr, "usage: surface OUT.ppm SAMPLES DOCUMENT...\n"), 2;
  nacre::System system;
  std::vector<nacre::Shader> shaders;
  std::vector<nacre::Binding> bindings;
  std::vector<float> states;
  for (int i = 3; i < argc; ++i) {
    const nacre::Document document = nacre::Document::read(argv[i]);
    shaders.push_back(system.compile_material(document, document.materials().at(0)));
    bindings.emplace_back(binder(), shaders.back());
    states.resize(std::max(states.size(), shaders.back().state_count() * pixels));
  }
  const auto spheres = std::uint32_t(shaders.size() - 1);
  std::vector<Vec> film(pixels);
  const int samples = std::max(1, std::atoi(argv[2]));
  std::mt19937 random(1);
  const auto number = [&] { return float(random() >> 8) * 0x1p-24f; };
  for (int sample = 0; sample < samples; ++sample) {
    std::vector<Path> paths(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const float x = (float(i % width) + number()) / width - 0.5f;
      const float y = 0.5f - (float(i / width) + number()) / height;
      paths[i].from = {0, 1.6f, 8.5f};
      paths[i].direction = unit({1.2f * x, 1.2f * y * height / width - 0.08f, -1});
      paths[i].pixel = i;
    }
    for (int bounce = 0; bounce < most_bounces && !paths.empty(); ++bounce) {
      // Which points have which material: kernels pick them from where they are.
      std::vector<std::vector<std::uint32_t>> lists(shaders.size());
      for (std::uint32_t i = 0; i < paths.size(); ++i) {
        Path& path = paths[i];
        path.u = {number(), number(), number()};
        const std::uint32_t material = trace(path, spheres);
        if (material == nothing) path.emission = Vec{0.4f, 0.46f, 0.6f} * (1 + path.direction.y);
        if (material != nothing) lists[material].push_back(i);
      }
      const std::vector<void*> arrays{paths.data(), states.data()};
      for (std::size_t m = 0; m < shaders.size(); ++m) {
        const nacre::Batch batch{lists[m].size(), lists[m].data()};
        for (const auto entry : {NACRE_EMISSION, NACRE_BEGIN, NACRE_SAMPLE}) {
          bindings[m].run(entry, arrays, batch);
        }
      }
      std::vector<Path> going_on;
      for (const Path& path : paths) {
        film[path.pixel] = film[path.pixel] + path.throughput * path.emission;
        if ((path.flags & NACRE_SAMPLE_VALID) == 0) continue;
        Path& next = going_on.emplace_back();
        next.from = path.P, next.direction = path.wi, next.pixel = path.pixel;
        next.throughput = path.throughput * path.weight;
      }
      paths = std::move(going_on);
    }
  }
  std::ofstream out(argv[1]);
  out << "P6\n" << width << ' ' << height << "\n255\n";
  for (const Vec& sum : film) {
    for (const float v : {sum.x, sum.y, sum.z}) {
      // By an integer: from 128 on there is no such char.
      out.put(char(int(255.99f * std::pow(std::min(v / float(samples), 1.0f), 1 / 2.2f))));
    }
  }
  return out.flush() ? 0 : 1;
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
