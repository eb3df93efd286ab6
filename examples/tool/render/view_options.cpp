#include "examples/tool/render/view_options.h"

#include <CLI/CLI.hpp>

#include "examples/tool/options.h"

namespace nacre::tool {

void ViewOptions::add(CLI::App& command) {
  command
      .add_option("--view", names.view,
                  "View of the --ocio configuration that shows a .png in place of --white and sRGB "
                  "(default: with --display, its default view)")
      ->excludes("--white")
      ->type_name("NAME");
  command
      .add_option("--display", names.display,
                  "Display of the --ocio configuration (default: with --view, its default display)")
      ->excludes("--white")
      ->type_name("NAME");
}

bool check_view(const ViewOptions& options, const std::string& out, Diagnostics& diagnostics) {
  if (!options.is_asked() || out.ends_with(".png")) return true;
  diagnostics.error("view-needs-png", {}, "a view is of a .png: an .exr has light",
                    "--out FILE.png", '\'' + out + '\'');
  return false;
}

std::shared_ptr<const DisplayView> load_view(const ViewOptions& options, const std::string& ocio,
                                             Diagnostics& diagnostics) {
  if (!options.is_asked()) return nullptr;
  if (ocio.empty()) {
    diagnostics.error("no-color-config", {}, "views are those of a configuration",
                      "--ocio FILE or --ocio env");
    return nullptr;
  }
  const auto config = ocio_config(ocio, diagnostics);
  return config ? load_display_view(*config, options.names, diagnostics) : nullptr;
}

}  // namespace nacre::tool
