// Images and textures of a system.
#include <array>

#include "jit/api/call.h"
#include "jit/api/handles.h"

using namespace nacre;
using namespace nacre::api;

nacre_status nacre_system_set_image(nacre_system* system, const char* name,
                                    const nacre_image* given, nacre_report* report) {
  if (system == nullptr || name == nullptr || *name == '\0' || given == nullptr ||
      !has_size(given)) {
    return NACRE_WRONG_ARGUMENTS;
  }
  constexpr std::array types{SampleType::unsigned8, SampleType::unsigned16, SampleType::half,
                             SampleType::floating};
  const nacre_image image = options_of(given);
  if (image.samples < NACRE_UINT8 || image.samples > NACRE_FLOAT32) return NACRE_WRONG_ARGUMENTS;
  return guarded(report, [&] {
    Said said(report);
    const Pixels pixels{.width = image.width,
                        .height = image.height,
                        .channels = image.channels,
                        .samples = types[static_cast<std::size_t>(image.samples)],
                        .data = image.pixels,
                        .row_bytes = image.row_bytes};
    const bool is_set = system->system->textures().set_image(name, pixels, said.diagnostics());
    return nacre_status{is_set ? NACRE_OK : NACRE_FAILED};
  });
}

void nacre_system_remove_image(nacre_system* system, const char* name) {
  if (system == nullptr || name == nullptr) return;
  guarded([&] {
    system->system->textures().remove_image(name);
    return nacre_status{NACRE_OK};
  });
}

nacre_status nacre_system_texture_statistics(const nacre_system* system,
                                             nacre_texture_statistics* statistics) {
  if (system == nullptr) return NACRE_WRONG_ARGUMENTS;
  const TextureStatistics now = system->system->textures().statistics();
  return give(statistics, nacre_texture_statistics{.size = 0,
                                                   .resident_bytes = now.resident_bytes,
                                                   .peak_resident_bytes = now.peak_resident_bytes,
                                                   .resident_textures = now.resident_textures,
                                                   .tiled_textures = now.tiled_textures,
                                                   .missing_textures = now.missing_textures,
                                                   .loads = now.loads,
                                                   .hits = now.hits,
                                                   .evictions = now.evictions,
                                                   .replaced_texels = now.replaced_texels,
                                                   .read_failures = now.read_failures});
}

void nacre_system_drop_textures(nacre_system* system) {
  if (system != nullptr) system->system->textures().drop_unused();
}
