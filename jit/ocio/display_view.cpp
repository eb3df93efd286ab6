#include "jit/ocio/display_view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "jit/ocio/open_ocio.h"
#include "runtime/float_environment.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

void report(const std::filesystem::path& path, const DisplayView::Names& names,
            const ViewFault& fault, Diagnostics& diagnostics) {
  const SourceLocation at{path.string(), 0, 0, {}};
  const bool is_display = fault.code == "unknown-display";
  if (fault.code == "bad-color-config") {
    report_bad_config(path, fault.reason, diagnostics);
  } else if (is_display || fault.code == "unknown-view") {
    const std::string& found = is_display ? names.display : names.view;
    diagnostics.error(
        fault.code, at,
        is_display ? "the configuration has no such display" : "the display has no such view",
        fault.known.empty() ? std::string(is_display ? "a configuration with displays" : "another")
                            : fmt::format("'{}'", fmt::join(fault.known, "', '")),
        '\'' + found + '\'', near_hint(diagnostics, found, fault.known));
  } else {
    diagnostics.error(fault.code, at, "there is no way to this view from what kernels give",
                      "a configuration with lin_rec709, aces_interchange or scene_linear",
                      fault.reason);
  }
}

}  // namespace

std::unique_ptr<DisplayView> load_display_view(const std::filesystem::path& path,
                                               const DisplayView::Names& names,
                                               Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const OcioModule* const module = open_ocio(path, diagnostics);
  if (module == nullptr) return nullptr;
  ViewFault fault;
  auto view = module->view(path.string(), names, *color_matrix("lin_rec709", "lin_ap0"), fault);
  if (view == nullptr) report(path, names, fault, diagnostics);
  return view;
}

}  // namespace nacre
