#pragma once

#include <memory>
#include <string>
#include <vector>

#include "jit/graph/color/color_config.h"
#include "jit/graph/color/colorspace.h"
#include "jit/ocio/display_view.h"
#include "runtime/module.h"

namespace nacre {

/// Why there is no view.
struct ViewFault {
  std::string code;                ///< Of load_display_view().
  std::string reason;              ///< OpenColorIO's, for a file or a way there.
  std::vector<std::string> known;  ///< The displays or views that there are.
};

/// The module nacre_colors: all that needs OpenColorIO.
struct OcioModule : ModuleHead {
  /// What a file config.ocio has; null, with the reason in `fault`, if it cannot be read.
  std::shared_ptr<const ColorConfig> (*load)(const std::string& path, std::string& fault);
  /// As load_display_view(); `to_aces`: from linear Rec. 709 to ACES 2065-1.
  std::unique_ptr<DisplayView> (*view)(const std::string& path, const DisplayView::Names& names,
                                       const ColorMatrix& to_aces, ViewFault& fault);
};

}  // namespace nacre
