#include "tests/fuzz/host.h"

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "jit/graph/find.h"

namespace nacre::fuzz {

namespace {

constexpr std::size_t points = 5;
constexpr std::size_t most_kernels = 8;  // Of one document; the rest is more of the same.

std::unique_ptr<ShadingSystem> create_host() {
  const char* folder = std::getenv("NACRE_MATERIALX_LIBRARIES");
  SystemOptions options;
  options.libraries = {folder != nullptr ? folder : NACRE_MATERIALX_LIBRARIES_DIR};
  options.textures.limits.max_size = 256;
  options.textures.limits.max_bytes = 1 << 20;
  options.compile_threads = 1;
  Diagnostics diagnostics;
  auto system = ShadingSystem::create(options, diagnostics);
  if (system == nullptr) fail(diagnostics.to_string());
  return system;
}

using Channels = std::map<std::string, std::vector<std::uint32_t>>;

/// Runs a kernel on channels by name; what is not there is a ramp through 0.
void run(const BoundKernel& kernel, Channels& channels) {
  const Program& program = kernel.program();
  std::vector<const void*> inputs;
  for (const auto& input : program.inputs) {
    auto& column = channels[input.name];
    for (std::size_t i = column.size(); i < points; ++i) {
      const float ramp = 0.375f * static_cast<float>(i) - 0.5f;
      column.push_back(std::bit_cast<std::uint32_t>(ramp));
    }
    inputs.push_back(column.data());
  }
  std::map<std::string, std::vector<std::uint32_t>> results;
  std::vector<void*> outputs;
  for (const auto& output : program.outputs) {
    auto& column = results[output.name];
    column.resize(points);
    outputs.push_back(column.data());
  }
  // Whatever it holds: a kernel that fails has done its part by ending.
  (void)kernel.run(inputs, outputs, points);
  for (auto& [name, column] : results) channels[name] = std::move(column);
}

/// Compiles the parts of a document one by one, each with diagnostics of its own.
class Shading {
 public:
  Shading(const Document& document, const ShaderOptions& options, bool agreeing)
      : document_(document), options_(options), agreeing_(agreeing) {}

  Shaded run_all() {
    host().check(document_, options_, checked_);
    shaded_.clean = !checked_.has_errors();
    for (const Diagnostic& one : checked_.all()) said_.insert(key_of(one));
    std::size_t count = 0;
    for (const FoundOutput& output : find_outputs(document_)) {
      if (has_kernel(output.type) && ++count <= most_kernels) shade_output(output.name);
    }
    count = 0;
    for (const FoundMaterial& material : find_materials(document_)) {
      if (++count <= most_kernels) shade_material(material.name);
    }
    return shaded_;
  }

 private:
  using Key = std::tuple<std::string, std::string, int, std::string>;
  static Key key_of(const Diagnostic& one) {
    return {one.code, one.where.file, one.where.line, one.where.path};
  }

  void judge(const std::string& what, bool made, const Diagnostics& diagnostics) const {
    if (!made && !diagnostics.has_errors()) fail(what + ": refused without a reason");
    if (!agreeing_) return;
    if (shaded_.clean && !made) {
      fail(what + ": checking found no error, compiling\n" + diagnostics.to_string());
    }
    if (!shaded_.clean) return;
    for (const Diagnostic& one : diagnostics.all()) {
      if (said_.contains(key_of(one))) continue;
      fail(what + ": checking did not say what compiling says\n" + one.to_string());
    }
  }

  void shade(const BoundKernel& kernel, Channels& channels) {
    run(kernel, channels);
    ++shaded_.kernels;
  }

  void shade_output(const std::string& name) {
    Diagnostics diagnostics;
    const auto shader = host().compile_outputs(document_, {name}, options_, diagnostics);
    judge(name, shader != nullptr, diagnostics);
    Channels channels;
    if (shader != nullptr) shade(shader->kernel, channels);
  }

  void shade_material(const std::string& name) {
    Diagnostics diagnostics;
    const auto kernels = host().compile_material(document_, name, options_, diagnostics);
    judge(name, kernels != nullptr, diagnostics);
    if (kernels == nullptr) return;
    Channels channels;  // begin's outputs are what the others read
    for (const auto* kernel :
         {&kernels->begin, &kernels->sample, &kernels->evaluate, &kernels->albedo,
          &kernels->emission, &kernels->opacity, &kernels->displacement, &kernels->volume}) {
      if (*kernel) shade(**kernel, channels);
    }
  }

  const Document& document_;
  const ShaderOptions& options_;
  bool agreeing_;
  Shaded shaded_;
  Diagnostics checked_;
  std::set<Key> said_;
};

}  // namespace

ShadingSystem& host() {
  static const std::unique_ptr<ShadingSystem> system = create_host();
  return *system;
}

ReadOptions read_options() {
  ReadOptions options;
  options.limits.file_bytes = 1 << 16;
  options.limits.total_bytes = 1 << 18;
  options.limits.files = 8;
  options.limits.elements = 4000;
  return options;
}

ShaderOptions shader_options() {
  ShaderOptions options;
  options.compile.backend = Backend::interpreter;
  options.graph.max_nodes = 500;
  return options;
}

Shaded shade_everything(const Document& document, const ShaderOptions& options, bool agreeing) {
  return Shading(document, options, agreeing).run_all();
}

void fail(const std::string& reason) {
  std::fprintf(stderr, "%s\n", reason.c_str());
  std::abort();
}

}  // namespace nacre::fuzz
