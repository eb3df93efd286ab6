#include "jit/shading/system_parts.h"

#include <utility>
#include <vector>

#include "jit/ocio/ocio_config.h"
#include "pbs/library.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

namespace fs = std::filesystem;

/// Where a node pack's texts may include from: the library folders.
std::vector<fs::path> text_roots(const std::vector<fs::path>& libraries) {
  std::vector<fs::path> roots;
  std::error_code ignored;
  for (const fs::path& path : libraries) {
    roots.push_back(fs::is_directory(path, ignored) ? path : path.parent_path());
  }
  return roots;
}

}  // namespace

std::unique_ptr<SystemParts> SystemParts::create(const SystemOptions& options,
                                                 Diagnostics& diagnostics) {
  auto parts = std::make_unique<SystemParts>();
  parts->library =
      load_library(options.libraries, diagnostics,
                   {.read = {}, .standard_texts = options.standard_texts, .more = own_library()});
  if (parts->library == nullptr) return nullptr;
  const Definitions& definitions = parts->library->definitions();
  parts->bodies = std::make_unique<Bodies>(definitions);
  for (const HostBody& body : options.bodies) {
    if (!body.record) {
      diagnostics.error("empty-body", {}, "the host's body for '" + body.nodedef + "' is empty",
                        "a function that records the node", "none");
      return nullptr;
    }
    if (parts->bodies->add(body.nodedef, body.record, definitions)) continue;
    diagnostics.error("unknown-nodedef", {},
                      "the host has a body for a nodedef that no library declares",
                      "the name of a nodedef", body.nodedef,
                      near_hint(diagnostics, body.nodedef, definitions.all(),
                                [](const NodeDef* each) { return each->name; }));
    return nullptr;
  }
  parts->texts = std::make_unique<TextBodies>(text_roots(options.libraries));
  parts->colors = options.colors;
  if (parts->colors == nullptr && !options.ocio_config.empty()) {
    parts->colors = load_ocio_config(options.ocio_config, diagnostics);
    if (parts->colors == nullptr) return nullptr;
  }
  parts->textures = std::make_unique<TextureStore>(options.textures);
  parts->resolver = options.resolver;
  ServiceOptions service{.threads = options.compile_threads, .cache = options.cache, .session = {}};
  service.executor = options.executor;
  if (options.compile_apart) {
    service.worker = find_worker();
    if (service.worker.empty()) {
      diagnostics.warning(
          "no-worker", {},
          "there is no nacre-compile-worker, so kernels are compiled in this process",
          "one beside the library, or NACRE_COMPILE_WORKER=FILE");
    }
  }
  parts->service = CompileService::create(service, diagnostics);
  return parts;
}

GraphOptions SystemParts::graph_options(const ShaderOptions& options) const {
  GraphOptions result = options.graph;
  result.is_native = [this](std::string_view nodedef) { return bodies->contains(nodedef); };
  if (result.colors == nullptr) result.colors = colors;
  result.stop = options.compile.stop;
  return result;
}

std::optional<Graph> SystemParts::build(const Document& document, const GraphRequest& request,
                                        const ShaderOptions& options,
                                        Diagnostics& diagnostics) const {
  return build_graph(document, *library, request, graph_options(options), diagnostics);
}

}  // namespace nacre
