#include "jit/ocio/ocio_config.h"

#include <utility>

#include "jit/ocio/open_ocio.h"
#include "runtime/float_environment.h"

namespace nacre {

std::shared_ptr<const ColorConfig> load_ocio_config(const std::filesystem::path& path,
                                                    Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const OcioModule* const module = open_ocio(path, diagnostics);
  if (module == nullptr) return nullptr;
  std::string found;
  auto config = module->load(path.string(), found);
  if (config == nullptr) report_bad_config(path, std::move(found), diagnostics);
  return config;
}

}  // namespace nacre
