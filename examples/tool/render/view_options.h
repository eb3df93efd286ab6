#pragma once

#include <memory>
#include <string>

#include "jit/ocio/display_view.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// What shows a picture, in place of our own curve and sRGB.
struct ViewOptions {
  DisplayView::Names names;  ///< --display and --view

  void add(CLI::App& command);
  bool is_asked() const { return !names.display.empty() || !names.view.empty(); }
};

/// Whether `out` may be shown by one; an error if not.
bool check_view(const ViewOptions& options, const std::string& out, Diagnostics& diagnostics);

/// That of the configuration that --ocio names, "" for none. Null where none is asked for, or
/// with an error.
std::shared_ptr<const DisplayView> load_view(const ViewOptions& options, const std::string& ocio,
                                             Diagnostics& diagnostics);

}  // namespace nacre::tool
