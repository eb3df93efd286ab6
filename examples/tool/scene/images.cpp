#include "examples/tool/scene/images.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "examples/common/atomic_file.h"

namespace nacre::tool {

namespace fs = std::filesystem;

std::vector<std::string> scene_image_files(const std::vector<host::SceneImage>& images,
                                           const std::string& scene_file, const std::string& stem,
                                           const std::string& folder) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const host::SceneImage& image = images[i];
    if (image.bytes != nullptr) {
      files.push_back(fmt::format("{}_image{}{}", stem, i, image.extension));
      continue;
    }
    std::error_code status;
    const fs::path place = fs::weakly_canonical(
        fs::absolute(fs::path(scene_file).parent_path() / image.file, status), status);
    const fs::path to = fs::weakly_canonical(fs::absolute(folder, status), status);
    files.push_back(folder.empty() ? image.file : fs::relative(place, to, status).string());
  }
  return files;
}

FileResolver scene_image_resolver(const std::vector<host::SceneImage>& images,
                                  const std::vector<std::string>& files) {
  std::map<std::string, std::shared_ptr<const std::string>> known;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].bytes != nullptr) known[files[i]] = images[i].bytes;
  }
  return [known = std::move(known)](const std::string& name, const std::string&,
                                    FileKind) -> std::optional<ResolvedFile> {
    const auto found = known.find(name);
    if (found == known.end()) return {};
    return ResolvedFile{name, found->second};
  };
}

bool write_scene_images(const std::vector<host::SceneImage>& images,
                        const std::vector<std::string>& files, const std::string& folder,
                        Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].bytes == nullptr) continue;
    const std::string path = (fs::path(folder) / files[i]).string();
    if (!host::write_text_atomically(path, *images[i].bytes, diagnostics)) return false;
  }
  return true;
}

}  // namespace nacre::tool
