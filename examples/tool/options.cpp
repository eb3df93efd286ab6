#include "examples/tool/options.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

fs::path default_cache() {
  if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder != nullptr && *folder != '\0') {
    return fs::path(folder) / "nacre";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return fs::path(home) / ".cache" / "nacre";
  }
  return {};
}

}  // namespace

void CommonOptions::add_document(CLI::App& command) {
  command.add_option("FILE", file, "MaterialX document")->required()->type_name("FILE.mtlx");
  command.add_option("--library", libraries, "Further node definitions: a file or folder")
      ->type_name("DIR");
  command.add_option("--search-path", search_paths, "Where includes and images are looked for too")
      ->type_name("DIR");
  command.add_flag("-q,--quiet", quiet, "No progress on standard error");
}

void CommonOptions::add_compile(CLI::App& command) {
  command.add_option("--accuracy", accuracy, "Error promised for every function and closure")
      ->check(CLI::IsMember({"precise", "standard", "fast"}))
      ->capture_default_str();
  command.add_option("--backend", backend, "Engine that runs the kernels")
      ->check(CLI::IsMember({"jit", "interpreter", "reference"}))
      ->capture_default_str();
  command.add_option("--lanes", lanes, "Points side by side in compiled code (default: by CPU)")
      ->check(CLI::IsMember({1, 4, 8, 16}));
  command.add_option("--threads", threads, "Threads (default: all)")->check(CLI::NonNegativeNumber);
  command.add_option("--cache", cache, "Folder of compiled kernels (default: in the user's cache)")
      ->type_name("DIR");
  command
      .add_option("--working-space", working_space,
                  "Colour space to compute in; \"\": the one the document's root names")
      ->type_name("NAME")
      ->capture_default_str();
  command.add_flag("--no-cache", no_cache, "Neither read nor write compiled kernels");
}

Accuracy CommonOptions::parsed_accuracy() const {
  if (accuracy == "precise") return Accuracy::precise;
  return accuracy == "fast" ? Accuracy::fast : Accuracy::standard;
}

Backend CommonOptions::parsed_backend() const {
  if (backend == "interpreter") return Backend::interpreter;
  return backend == "reference" ? Backend::reference : Backend::jit;
}

ShaderOptions CommonOptions::shader_options() const {
  ShaderOptions options;
  options.compile.accuracy = parsed_accuracy();
  options.compile.backend = parsed_backend();
  options.compile.lanes = lanes;
  options.graph.working_space = working_space;
  for (const std::string& path : search_paths) options.search_paths.emplace_back(path);
  return options;
}

Opened open(const CommonOptions& options, Diagnostics& diagnostics) {
  Opened opened;
  const fs::path data = find_materialx_libraries();
  if (data.empty()) {
    diagnostics.error("no-data-library", {}, "the MaterialX data library was not found",
                      "NACRE_MATERIALX_LIBRARIES to name the folder that holds stdlib/");
    return opened;
  }
  SystemOptions system;
  system.libraries.push_back(data);
  for (const std::string& library : options.libraries) system.libraries.emplace_back(library);
  system.compile_threads = options.threads;
  if (!options.no_cache) {
    system.cache = options.cache.empty() ? default_cache() : fs::path(options.cache);
  }
  opened.system = ShadingSystem::create(system, diagnostics);
  if (opened.system == nullptr) return opened;
  ReadOptions read;
  for (const std::string& path : options.search_paths) read.search_paths.emplace_back(path);
  opened.document = read_document(options.file, read, diagnostics);
  return opened;
}

int report(const Diagnostics& diagnostics) {
  std::fputs(diagnostics.to_string().c_str(), stderr);
  return diagnostics.has_errors() ? status_problems : status_ok;
}

ProgressLine::ProgressLine(std::string title, bool quiet)
    : title_(std::move(title)), active_(!quiet && isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (active_ && shown_ >= 0) std::fputs("\r\033[K", stderr);
}

void ProgressLine::update(double share) {
  const int percent = static_cast<int>(100.0 * share);
  if (!active_ || percent == shown_) return;
  shown_ = percent;
  std::fprintf(stderr, "\r%s %3d %%", title_.c_str(), percent);
  std::fflush(stderr);
}

}  // namespace nacre::tool
