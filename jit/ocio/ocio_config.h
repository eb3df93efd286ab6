#pragma once

#include <filesystem>
#include <memory>

#include "jit/graph/color/color_config.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// The colour spaces of an OpenColorIO configuration, a file config.ocio. Null, with a
/// diagnostic, if it cannot be read. Look-up tables that it names are read when a
/// transform that needs them is asked for first. OpenColorIO itself is loaded by the first
/// configuration.
///
/// Transforms are those that OpenColorIO gives to graphics cards, optimised without
/// loss: what it has no exact form for there it approximates, which is the inverse of
/// a 1D table (by one of 4096 or, for half floats, 65536 entries) and of a 3D table (by
/// one of 48^3). Looks, file rules and named transforms are not used here, nor displays
/// and views (display_view.h), and so not checked. Environment variables that the configuration
/// refers to count as they are when it is read.
///
/// OpenColorIO's logging is turned off while it works for us; OCIO_LOGGING_LEVEL in the
/// environment, which OpenColorIO puts above what programs say, turns it on again.
std::shared_ptr<const ColorConfig> load_ocio_config(const std::filesystem::path& path,
                                                    Diagnostics& diagnostics);

}  // namespace nacre
