#include "examples/image_input/graph_module.h"

#include <dlfcn.h>

#include <filesystem>
#include <string_view>

#include "examples/image_input/wrong.h"

namespace graph_image {

namespace {

namespace fs = std::filesystem;

/// Where this plug-in is.
fs::path own_file() {
  Dl_info about{};
  if (::dladdr(reinterpret_cast<const void*>(&open_by_module), &about) == 0) return {};
  return about.dli_fname;
}

/// It stays as long as the process.
const GraphModule* load() {
  const fs::path file = own_file().parent_path().parent_path() / "nacre_graphs.so";
  void* const opened = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (opened == nullptr) {
    const char* const reason = ::dlerror();
    throw Wrong(file.string(), "no-module", "what shades graphs cannot be loaded", {},
                reason != nullptr ? reason : "");
  }
  using Entry = const GraphModule*();
  const auto entry = reinterpret_cast<Entry*>(::dlsym(opened, "nacre_module"));
  const GraphModule* const module = entry != nullptr ? entry() : nullptr;
  if (module == nullptr || module->build != std::string_view(NACRE_BUILD_KEY)) {
    throw Wrong(file.string(), "no-module",
                "what shades graphs is of another build than the plug-in");
  }
  return module;
}

}  // namespace

std::unique_ptr<OpenedGraph> open_by_module(const Request& request) {
  static const GraphModule* const module = load();  // Tried again after an exception.
  return module->open(request);
}

}  // namespace graph_image
