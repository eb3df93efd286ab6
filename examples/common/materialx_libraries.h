#pragma once

#include <filesystem>

namespace nacre {

/// The folder of the MaterialX data library (it holds stdlib/stdlib_defs.mtlx), or an
/// empty path. The first of these that has it:
/// 1. the environment variable NACRE_MATERIALX_LIBRARIES; when set it is the only answer,
///    so that a wrong value is noticed;
/// 2. ../share/nacre/libraries from the folder of the running program (installed);
/// 3. the folder that the build was configured with (build tree).
std::filesystem::path find_materialx_libraries();

/// The same with its three places given: `environment` may be null, `program` is the path
/// of the executable.
std::filesystem::path find_materialx_libraries(const char* environment,
                                               const std::filesystem::path& program,
                                               const std::filesystem::path& built_with);

}  // namespace nacre
