#pragma once

#include "jit/ocio/ocio_module.h"

namespace nacre {

/// OcioModule's functions.
std::shared_ptr<const ColorConfig> load_config(const std::string& path, std::string& fault);
std::unique_ptr<DisplayView> load_view(const std::string& path, const DisplayView::Names& names,
                                       const ColorMatrix& to_aces, ViewFault& fault);

}  // namespace nacre
