// The smallest host: compiles one graph output and shades a batch of points.
//
//   embed LIBRARY DOCUMENT.mtlx GRAPH/OUTPUT
//
// LIBRARY is the MaterialX data library, installed as share/nacre/libraries.
#include <cstdio>
#include <vector>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: embed LIBRARY DOCUMENT GRAPH/OUTPUT\n"), 2;
  nacre::Diagnostics diagnostics;
  const auto fail = [&] {
    std::fputs(diagnostics.to_string().c_str(), stderr);
    return 1;
  };

  // 1. What all documents share: node definitions, textures, the compiler.
  const auto system = nacre::ShadingSystem::create({.libraries = {argv[1]}}, diagnostics);
  if (system == nullptr) return fail();

  // 2. A document, and a kernel for one of its outputs.
  const auto document = nacre::read_document(argv[2], {}, diagnostics);
  if (document == nullptr) return fail();
  const auto shader = system->compile_outputs(*document, {argv[3]}, {}, diagnostics);
  if (shader == nullptr) return fail();

  // 3. Points in structure-of-arrays layout: one array for each channel it asks for.
  constexpr std::size_t points = 8;
  const nacre::Program& program = shader->kernel.program();
  std::vector<std::vector<float>> inputs(program.inputs.size(), std::vector<float>(points));
  std::vector<const void*> in;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const std::string& channel = program.inputs[k].name;
    const bool sweeps = channel == "uv0.x" || channel == "P.x" || channel == "Po.x";
    for (std::size_t i = 0; i < points; ++i) inputs[k][i] = sweeps ? float(i) / points : 0.5f;
    in.push_back(inputs[k].data());
  }
  std::vector<std::vector<float>> outputs(program.outputs.size(), std::vector<float>(points));
  std::vector<void*> out;
  for (auto& channel : outputs) out.push_back(channel.data());

  // 4. Shade. Any number of threads may do this with the same kernel.
  if (shader->kernel.run(in, out, points) != nacre::RunStatus::done) {
    std::fprintf(stderr, "a loop of the shader does not end\n");
    return 1;
  }
  for (std::size_t i = 0; i < points; ++i) {
    for (const auto& channel : outputs) std::printf("%9.5f", double(channel[i]));
    std::printf("\n");
  }
  return 0;
}
