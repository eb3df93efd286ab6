#pragma once

#include <nlohmann/json_fwd.hpp>

#include "examples/render/render.h"
#include "examples/tool/render/options.h"

namespace nacre::tool {

/// What `nacre render --json` says of a picture that is not written,
nlohmann::ordered_json unwritten_picture(const RenderOptions& options, const Picture& picture);

/// of one that was there before,
nlohmann::ordered_json skipped_picture(const RenderOptions& options, const Picture& picture);

/// and of one that is: its size, passes and samples, and what they took.
nlohmann::ordered_json written_picture(const RenderOptions& options,
                                       const host::RenderSettings& settings, const Picture& picture,
                                       const host::RenderStatistics& statistics);

/// All of it, of "pictures" as far as they were come to: the one picture, or, where frames or
/// cameras were asked for, the list.
nlohmann::ordered_json final_answer(const RenderOptions& options,
                                    const nlohmann::ordered_json& pictures);

/// Notes that a picture was left out because it is there.
void report_skipped(const std::string& file, Diagnostics& diagnostics);

}  // namespace nacre::tool
