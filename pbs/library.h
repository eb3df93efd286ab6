#pragma once

#include <string_view>
#include <utility>
#include <vector>

namespace nacre {

/// Nodedefs that the MaterialX data library lacks, and graphs that implement some of them:
/// name ("nacre:shaderx.mtlx") and text of each file of pbs/library, by name. They are read after
/// the data library, which wins where both declare a name.
const std::vector<std::pair<std::string_view, std::string_view>>& own_library();

}  // namespace nacre
