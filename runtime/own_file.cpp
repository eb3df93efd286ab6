#include "runtime/own_file.h"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <string_view>
#include <system_error>

namespace nacre {

namespace {

namespace fs = std::filesystem;

/// The file that this code was loaded from; empty if nobody knows.
fs::path own_path() {
  Dl_info ignored{};
  void* extra = nullptr;
  if (::dladdr1(reinterpret_cast<const void*>(&own_path), &ignored, &extra, RTLD_DL_LINKMAP) == 0) {
    return {};
  }
  const std::string_view loaded = static_cast<const link_map*>(extra)->l_name;
  std::error_code error;
  // A program has no name there, and the one that it was called by is no path.
  if (loaded.empty()) return fs::read_symlink("/proc/self/exe", error);
  return fs::weakly_canonical(loaded, error);
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

}  // namespace

std::vector<fs::path> places_of(const OwnFile& file) {
  const fs::path own = own_path();
  if (own.empty()) return {};
  const fs::path folder = own.parent_path();
  std::vector<fs::path> places{(folder / ".." / file.installed).lexically_normal(),
                               (folder / ".." / ".." / file.installed).lexically_normal()};
  std::error_code error;
  const fs::path build = fs::weakly_canonical(NACRE_BUILD_FOLDER, error);
  if (!error && is_below(own, build)) places.push_back((build / file.built).lexically_normal());
  return places;
}

fs::path find_own_file(const OwnFile& file) {
  std::error_code ignored;
  for (fs::path& place : places_of(file)) {
    if (fs::is_regular_file(place, ignored)) return std::move(place);
  }
  return {};
}

}  // namespace nacre
