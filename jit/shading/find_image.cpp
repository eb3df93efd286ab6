#include "jit/shading/find_image.h"

#include <system_error>

namespace nacre {

namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& path, bool is_pattern) {
  std::error_code ignored;
  if (!is_pattern) return fs::exists(path, ignored);
  const fs::path folder = path.parent_path();
  return fs::is_directory(folder.empty() ? fs::path(".") : folder, ignored);
}

}  // namespace

FileRoots image_roots(const Graph& graph, const std::vector<fs::path>& search_paths,
                      const std::vector<fs::path>& libraries) {
  FileRoots roots;
  if (graph.document.empty()) return roots;
  roots.add(fs::path(graph.document).parent_path());
  for (const fs::path& path : search_paths) roots.add(path);
  for (const fs::path& path : libraries) roots.add(path);
  return roots;
}

ImageAccess image_access(const FileRoots& roots, MissingImages missing, const Stop& stop) {
  ImageAccess access{.missing = missing, .may_read = {}, .stop = stop};
  if (!roots.empty()) {
    access.may_read = [roots](const std::string& path) { return roots.hold(path); };
  }
  return access;
}

std::string find_image(const std::string& name, const std::string& document,
                       const std::vector<fs::path>& search_paths, const FileRoots& roots) {
  std::vector<fs::path> folders;
  if (!document.empty()) folders.push_back(fs::path(document).parent_path());
  folders.insert(folders.end(), search_paths.begin(), search_paths.end());
  if (folders.empty()) folders.emplace_back();
  const bool is_pattern = name.find('<') != std::string::npos;
  fs::path refused;
  fs::path missing;
  for (const fs::path& folder : folders) {
    const fs::path place = (folder / name).lexically_normal();
    if (!roots.empty() && !roots.hold(place)) {
      if (refused.empty()) refused = place;
    } else if (is_there(place, is_pattern)) {
      return place.string();
    } else if (missing.empty()) {
      missing = place;
    }
  }
  return (missing.empty() ? refused : missing).string();
}

}  // namespace nacre
