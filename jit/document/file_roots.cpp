#include "jit/document/file_roots.h"

#include <algorithm>
#include <iterator>
#include <system_error>

namespace nacre {

namespace fs = std::filesystem;

namespace {

bool is_below(const fs::path& file, const fs::path& folder) {
  const auto ends = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return ends.first == folder.end() ||
         (ends.first->empty() && std::next(ends.first) == folder.end());
}

}  // namespace

fs::path canonical_path(const fs::path& path) {
  std::error_code error;
  // First as it is written: a folder that is not there and ".." behind it say nothing.
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  fs::path canonical = fs::weakly_canonical(whole, error);
  return error ? whole : canonical;
}

void FileRoots::add(const fs::path& folder) {
  std::error_code error;
  const fs::path canonical =
      fs::weakly_canonical(fs::absolute(folder.empty() ? fs::path(".") : folder, error), error);
  if (!error) folders_.push_back(canonical);
}

bool FileRoots::hold(const fs::path& file) const {
  const fs::path canonical = canonical_path(file);
  return std::any_of(folders_.begin(), folders_.end(),
                     [&](const fs::path& folder) { return is_below(canonical, folder); });
}

}  // namespace nacre
