#include <cstddef>

#include "jit/api/call.h"
#include "jit/api/handles.h"
#include "jit/api/node.h"

using namespace nacre;
using namespace nacre::api;

nacre_status nacre_system_create(const nacre_system_options* given, nacre_report* report,
                                 nacre_system** system) {
  if (system == nullptr) return NACRE_WRONG_ARGUMENTS;
  *system = nullptr;
  if (!has_size(given)) return NACRE_WRONG_ARGUMENTS;
  return guarded(report, [&] {
    const nacre_system_options asked = options_of(given);
    if (asked.body_count != 0 && !has_size(asked.bodies))
      return nacre_status{NACRE_WRONG_ARGUMENTS};
    Said said(report);
    SystemOptions options;
    for (const std::string& path : texts_of(asked.libraries, asked.library_count)) {
      options.libraries.emplace_back(path);
    }
    if (options.libraries.empty()) {
      const std::string own = nacre_data_library();
      if (own.empty()) {
        said.diagnostics().error("no-data-library", {}, "the MaterialX data library is not there",
                                 "share/nacre/libraries beside the library's folder, or "
                                 "nacre_system_options::libraries");
        return nacre_status{NACRE_FAILED};
      }
      options.libraries.emplace_back(own);
    }
    options.ocio_config = text_or_empty(asked.ocio_config);
    options.cache = text_or_empty(asked.cache);
    options.compile_threads = asked.compile_threads;
    options.compile_apart = asked.compile_apart != 0;
    const auto* bodies = reinterpret_cast<const std::byte*>(asked.bodies);
    for (std::size_t i = 0; bodies != nullptr && i < asked.body_count; ++i) {
      // As far apart as the host's version of them is long.
      options.bodies.push_back(
          host_body(*reinterpret_cast<const nacre_body*>(bodies + i * asked.bodies->size)));
    }
    if (asked.texture_memory != 0) options.textures.budget = asked.texture_memory;
    std::shared_ptr<ShadingSystem> made = ShadingSystem::create(options, said.diagnostics());
    if (made == nullptr) return nacre_status{NACRE_FAILED};
    *system = new nacre_system{std::move(made)};
    return nacre_status{NACRE_OK};
  });
}

void nacre_system_destroy(nacre_system* system) { delete system; }
