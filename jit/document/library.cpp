#include "jit/document/library.h"

#include <algorithm>

#include "runtime/float_environment.h"

namespace nacre {

namespace fs = std::filesystem;

namespace {

bool is_other_target(const fs::path& folder, bool with_sources) {
  const std::string name = folder.filename().string();
  if (name == source_target) return !with_sources;
  return name.starts_with("gen") || name == "targets";
}

// Overloads that match equally are told apart by document order, and the
// standard library's come first.
bool stdlib_first(const fs::path& a, const fs::path& b) {
  const auto is_standard = [](const fs::path& path) {
    return path.parent_path().filename() == "stdlib";
  };
  if (is_standard(a) != is_standard(b)) return is_standard(a);
  return a < b;
}

std::vector<fs::path> files_below(const fs::path& folder, bool with_sources) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error);
  const fs::recursive_directory_iterator end;
  while (!error && at != end) {
    if (at->is_directory(error) && is_other_target(at->path(), with_sources))
      at.disable_recursion_pending();
    if (at->path().extension() == ".mtlx") files.push_back(at->path());
    at.increment(error);
  }
  std::sort(files.begin(), files.end(), stdlib_first);
  return files;
}

}  // namespace

std::shared_ptr<const Library> load_library(const std::vector<fs::path>& paths,
                                            Diagnostics& diagnostics,
                                            const LibraryOptions& options) {
  const ScopedDefaultFloatEnvironment environment;
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    const bool is_standard = fs::is_directory(path / "stdlib", error);
    const std::vector<fs::path> found = files_below(path, options.standard_texts || !is_standard);
    if (found.empty()) {
      diagnostics.error("empty-library", {path.string(), 0, 0, ""},
                        "the library folder holds no .mtlx files");
    }
    files.insert(files.end(), found.begin(), found.end());
  }
  const std::size_t errors = diagnostics.error_count();
  std::unique_ptr<Document> document =
      read_documents(files, options.more, options.read, diagnostics);
  if (document == nullptr) return nullptr;
  auto library = std::make_shared<const Library>(std::move(document), diagnostics);
  return diagnostics.error_count() == errors ? library : nullptr;
}

}  // namespace nacre
