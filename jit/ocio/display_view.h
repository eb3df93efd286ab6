#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "runtime/diagnostic.h"

namespace nacre {

/// How a display shows a picture: a view of an OpenColorIO configuration.
class DisplayView {
 public:
  /// By the names that the configuration has for them.
  struct Names {
    std::string display;  ///< Empty: its default display.
    std::string view;     ///< Empty: the default view of the display.
  };

  virtual ~DisplayView() = default;

  virtual const Names& names() const = 0;  ///< None of them empty.
  /// Colours that kernels give, three numbers each, become what the display is sent: 0 to 1 is
  /// what it can show. Any finite numbers; from any thread.
  virtual void apply(std::span<float> rgb) const = 0;
};

/// That of a file config.ocio. Colours come in the working space that documents have where none is
/// asked for: lin_rec709, which the configuration has by that name or by its role
/// aces_interchange; else its role scene_linear. OpenColorIO's processor for the CPU works it out,
/// optimised without loss. Null, with a diagnostic, where the file cannot be read
/// (bad-color-config, no-color-reader), has no such display or view (unknown-display,
/// unknown-view), or no way there (no-view).
std::unique_ptr<DisplayView> load_display_view(const std::filesystem::path& path,
                                               const DisplayView::Names& names,
                                               Diagnostics& diagnostics);

}  // namespace nacre
