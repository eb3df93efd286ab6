#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

#include "examples/image_input/request.h"

namespace graph_image {

/// Of a name as OpenImageIO opens it, and of the attributes "mtlx:KEY" of a configuration, which
/// may be null: what the name says counts before those. Throws Wrong for keys that there are not
/// and for values that make no sense.
Request read_request(const std::string& name, const OIIO::ImageSpec* config);

}  // namespace graph_image
