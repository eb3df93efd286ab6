#include "jit/ocio/ocio_config.h"

#include <system_error>
#include <utility>

#include "jit/ocio/ocio_module.h"
#include "runtime/float_environment.h"

namespace nacre {

std::shared_ptr<const ColorConfig> load_ocio_config(const std::filesystem::path& path,
                                                    Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const auto fail = [&](std::string code, std::string message, std::string expected,
                        std::string found) {
    diagnostics.error(std::move(code), {path.string(), 0, 0, {}}, std::move(message),
                      std::move(expected), std::move(found));
    return nullptr;
  };
  const auto bad = [&](std::string found) {
    return fail("bad-color-config", "the OpenColorIO configuration cannot be read",
                "a file config.ocio", std::move(found));
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return bad("no such file");
  if (!NACRE_WITH_OPENCOLORIO) {
    return fail("no-color-reader", "this build of Nacre knows no OpenColorIO configurations",
                "one with OpenColorIO", "NACRE_WITH_OPENCOLORIO=OFF");
  }
  ModuleFault fault;
  const ModuleHead* const module = open_module("nacre_colors", fault);
  if (module == nullptr) {
    return fail("no-color-reader", "what reads OpenColorIO configurations cannot be loaded",
                std::move(fault.expected), std::move(fault.found));
  }
  std::string found;
  auto config = static_cast<const OcioModule*>(module)->load(path.string(), found);
  return config == nullptr ? bad(std::move(found)) : config;
}

}  // namespace nacre
