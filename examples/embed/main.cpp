// The smallest host: compiles one graph output and shades a batch of points.
//
//   embed DOCUMENT.mtlx GRAPH/OUTPUT
#include <cstdio>
#include <nacre/nacre.hpp>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 3) return std::fprintf(stderr, "usage: embed DOCUMENT GRAPH/OUTPUT\n"), 2;

  // 1. What all documents share: node definitions, textures, the compiler.
  nacre::System system;

  // 2. A document, and a kernel for one of its outputs.
  const nacre::Document document = nacre::Document::read(argv[1]);
  const nacre::Shader shader = system.compile_outputs(document, {argv[2]});

  // 3. Where the points' numbers are: array 0 has a structure for each, array 1 takes the result.
  struct Point {
    float position[3];
    float uv[2];
  };
  nacre::Binder binder;
  binder.array("P", {0, offsetof(Point, position), sizeof(Point)});
  binder.array("Po", {0, offsetof(Point, position), sizeof(Point)});
  binder.array("uv0", {0, offsetof(Point, uv), sizeof(Point)});
  for (const char* unit : {"N", "No", "Ng", "wo"}) binder.constant(unit, {0, 0, 1});
  for (const char* change : {"dPdx", "dPdy", "dPodx", "dPody", "duv0dx", "duv0dy"}) {
    binder.constant(change, {0, 0, 0});
  }
  const std::size_t components = shader.results(NACRE_OUTPUTS).size();
  binder.array(argv[2], {1, 0, std::ptrdiff_t(4 * components)});
  const nacre::Binding binding(binder, shader);

  // 4. Shade. Any number of threads may do this with the same binding.
  constexpr std::size_t count = 8;
  std::vector<Point> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = float(i) / count;
    points[i] = {{x, 0.5f, 0.5f}, {x, 0.5f}};
  }
  std::vector<float> results(components * count);
  nacre::Batch batch;
  batch.count = count;
  binding.run(NACRE_OUTPUTS, std::vector<void*>{points.data(), results.data()}, batch);
  for (std::size_t i = 0; i < results.size(); ++i) {
    std::printf("%9.5f%s", double(results[i]), (i + 1) % components == 0 ? "\n" : "");
  }
  return 0;
} catch (const nacre::Error& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
