#include "bench/common/system.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

#include "jit/document/read.h"

namespace nacre::bench {

namespace {

[[noreturn]] void give_up(const std::string& why) {
  fmt::print(stderr, "{}\n", why);
  std::exit(2);
}

}  // namespace

CompileService& compile_service() {
  static const std::unique_ptr<CompileService> service = [] {
    Diagnostics diagnostics;
    auto made = CompileService::create({.threads = 1, .cache = {}, .session = {}}, diagnostics);
    return made;
  }();
  return *service;
}

ShadingSystem& shading_system() {
  static const std::unique_ptr<ShadingSystem> system = [] {
    Diagnostics diagnostics;
    SystemOptions options;
    options.libraries = {NACRE_MATERIALX_LIBRARIES_DIR};
    options.compile_threads = 1;
    auto made = ShadingSystem::create(options, diagnostics);
    if (made == nullptr) give_up(diagnostics.to_string());
    return made;
  }();
  return *system;
}

const Document& bench_document(const std::string& file) {
  static std::map<std::string, std::unique_ptr<Document>> documents;
  std::unique_ptr<Document>& document = documents[file];
  if (document == nullptr) {
    Diagnostics diagnostics;
    document = read_document(std::string(NACRE_BENCH_DOCUMENTS) + "/" + file, {}, diagnostics);
    if (document == nullptr) give_up(diagnostics.to_string());
  }
  return *document;
}

std::unique_ptr<KernelRun> run_output(const Document& document, const std::string& output,
                                      const CompileOptions& options, std::string& error) {
  Diagnostics diagnostics;
  ShaderOptions shader;
  shader.compile = options;
  const auto made = shading_system().compile_outputs(document, {output}, shader, diagnostics);
  if (made == nullptr) {
    error = diagnostics.to_string();
    return nullptr;
  }
  return std::make_unique<KernelRun>(made->kernel);
}

std::unique_ptr<KernelRun> run_recorded(const Program& recorded, std::string name,
                                        std::span<const SliceOutput> outputs,
                                        const CompileOptions& options, std::string& error,
                                        const Columns& given) {
  Diagnostics diagnostics;
  auto kernel =
      compile(slice(recorded, std::move(name), outputs), options, &compile_service(), diagnostics);
  if (kernel == nullptr) {
    error = diagnostics.to_string();
    return nullptr;
  }
  return std::make_unique<KernelRun>(BoundKernel(std::move(kernel), nullptr), given);
}

}  // namespace nacre::bench
