#include <cstddef>

#include "jit/api/call.h"
#include "jit/api/colors.h"
#include "jit/api/handles.h"
#include "jit/api/hooks.h"
#include "jit/api/node.h"

using namespace nacre;
using namespace nacre::api;

namespace {

/// Whether what it refers to says how long it is, and has the functions that are called unasked.
bool is_meant(const nacre_system_options& asked) {
  if (asked.body_count != 0 && !has_size(asked.bodies)) return false;
  if (asked.executor != nullptr && options_of(asked.executor).submit == nullptr) return false;
  if (asked.allocator != nullptr && options_of(asked.allocator).allocate == nullptr) return false;
  return has_size(asked.colors) && has_size(asked.resolver) && has_size(asked.textures) &&
         has_size(asked.executor) && has_size(asked.allocator);
}

void limit_textures(const nacre_system_options& asked, TextureOptions& options) {
  if (asked.texture_memory != 0) options.budget = asked.texture_memory;
  if (asked.tile_memory != 0) options.tile_memory = asked.tile_memory;
  if (asked.max_image_size != 0) options.limits.max_size = asked.max_image_size;
  if (asked.max_image_bytes != 0) options.limits.max_bytes = asked.max_image_bytes;
  if (asked.max_image_file_bytes != 0) options.limits.max_file_bytes = asked.max_image_file_bytes;
  if (asked.max_image_channels > 0) options.limits.max_channels = asked.max_image_channels;
  if (asked.max_image_layers > 0) options.limits.max_layers = asked.max_image_layers;
  if (asked.max_image_expansion != 0) options.limits.max_expansion = asked.max_image_expansion;
  if (asked.max_image_tiles != 0) options.tiles.max_tiles = asked.max_image_tiles;
}

/// What is the host's is destroyed with the options, or with the last that was made of them: from
/// here on whatever else goes wrong.
void take_hooks(const nacre_system_options& asked, SystemOptions& options) {
  if (asked.colors != nullptr) options.colors = host_colors(*asked.colors);
  if (asked.resolver != nullptr) options.resolver = host_resolver(*asked.resolver);
  if (asked.textures != nullptr) options.textures.system = host_texture_system(*asked.textures);
  if (asked.executor != nullptr) options.executor = host_executor(*asked.executor);
  if (asked.allocator != nullptr) options.textures.memory = host_memory(*asked.allocator);
  const auto* bodies = reinterpret_cast<const std::byte*>(asked.bodies);
  for (std::size_t i = 0; bodies != nullptr && i < asked.body_count; ++i) {
    // As far apart as the host's version of them is long.
    options.bodies.push_back(
        host_body(*reinterpret_cast<const nacre_body*>(bodies + i * asked.bodies->size)));
  }
}

}  // namespace

nacre_status nacre_system_create(const nacre_system_options* given, nacre_report* report,
                                 nacre_system** system) {
  if (system == nullptr) return NACRE_WRONG_ARGUMENTS;
  *system = nullptr;
  if (!has_size(given)) return NACRE_WRONG_ARGUMENTS;
  return guarded(report, [&] {
    const nacre_system_options asked = options_of(given);
    if (!is_meant(asked)) return nacre_status{NACRE_WRONG_ARGUMENTS};
    Said said(report);
    SystemOptions options;
    take_hooks(asked, options);
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
    options.standard_texts = asked.standard_texts != 0;
    limit_textures(asked, options.textures);
    std::shared_ptr<ShadingSystem> made = ShadingSystem::create(options, said.diagnostics());
    if (made == nullptr) return nacre_status{NACRE_FAILED};
    *system = new nacre_system{std::move(made), {}};
    return nacre_status{NACRE_OK};
  });
}

void nacre_system_destroy(nacre_system* system) { delete system; }
