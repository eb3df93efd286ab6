#pragma once

#include <nlohmann/json_fwd.hpp>

#include "examples/tool/render/moment.h"
#include "examples/tool/render/series_options.h"

namespace nacre::tool {

/// A picture, and where it stands among those of its run.
struct PictureAtWork {
  const Picture& picture;
  std::size_t number = 0, of = 1;  ///< Counted from 1 among those that are to be rendered.
  bool is_last_of_world = true;    ///< The scene is not needed any more.
  const host::Denoiser* denoiser = nullptr;  ///< Null: it stays as it is.
};

/// Renders a picture and writes it. What RenderOptions::json says of it goes to `answer`. False
/// after an error, or where there is no picture.
bool render_picture(const RenderOptions& options, const Opened& opened, RenderMoment& moment,
                    const PictureAtWork& work, RenderStop& stop, nlohmann::ordered_json& answer,
                    Diagnostics& diagnostics);

}  // namespace nacre::tool
