#include "runtime/texture/similar_name.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

namespace nacre {

namespace fs = std::filesystem;

namespace {

constexpr int most_entries = 10'000;  // Of a folder: a hint is not worth more.

bool is_same(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

/// The entry of a folder that `name` could mean; empty if there is none.
fs::path similar_entry(const fs::path& folder, const std::string& name) {
  std::error_code error;
  int entries = 0;
  for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error), end;
       !error && entry != end && ++entries <= most_entries; entry.increment(error)) {
    const fs::path found = entry->path().filename();
    if (is_same(found.string(), name)) return found;
  }
  return {};
}

}  // namespace

std::string find_other_case(const std::string& path) {
  std::error_code error;
  fs::path found;
  for (const fs::path& part : fs::path(path).lexically_normal()) {
    if (fs::exists(found / part, error)) {
      found /= part;
      continue;
    }
    const fs::path entry = similar_entry(found, part.string());
    if (entry.empty()) return {};
    found /= entry;
  }
  return fs::is_regular_file(found, error) ? found.string() : std::string();
}

}  // namespace nacre
