#include "jit/ocio/open_ocio.h"

#include <system_error>
#include <utility>

namespace nacre {

const OcioModule* open_ocio(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const auto none = [&](std::string message, std::string expected, std::string found) {
    diagnostics.error("no-color-reader", {path.string(), 0, 0, {}}, std::move(message),
                      std::move(expected), std::move(found));
    return nullptr;
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    report_bad_config(path, "no such file", diagnostics);
    return nullptr;
  }
  if (!NACRE_WITH_OPENCOLORIO) {
    return none("this build of Nacre knows no OpenColorIO configurations", "one with OpenColorIO",
                "NACRE_WITH_OPENCOLORIO=OFF");
  }
  ModuleFault fault;
  const ModuleHead* const module = open_module("nacre_colors", fault);
  if (module == nullptr) {
    return none("what reads OpenColorIO configurations cannot be loaded", std::move(fault.expected),
                std::move(fault.found));
  }
  return static_cast<const OcioModule*>(module);
}

void report_bad_config(const std::filesystem::path& path, std::string found,
                       Diagnostics& diagnostics) {
  diagnostics.error("bad-color-config", {path.string(), 0, 0, {}},
                    "the OpenColorIO configuration cannot be read", "a file config.ocio",
                    std::move(found));
}

}  // namespace nacre
