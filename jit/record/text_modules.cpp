#include "jit/record/text_modules.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "runtime/read_file.h"

namespace nacre {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_file_bytes = std::uint64_t{4} << 20;

bool is_below(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path inner = fs::weakly_canonical(path, error);
  const fs::path outer = fs::weakly_canonical(folder.empty() ? "." : folder, error);
  const auto [end, ignored] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return end == outer.end();
}

/// Looks for `name` in the folders, in order, and reads it; only below `allowed`. Notes the
/// file as it was before.
std::optional<glsl::Sources::File> find_file(const std::string& name,
                                             const std::vector<fs::path>& folders,
                                             const std::vector<fs::path>& allowed,
                                             std::map<std::string, FileIdentity>& files) {
  for (const fs::path& folder : folders) {
    const fs::path path = (folder / name).lexically_normal();
    const bool may_read = std::any_of(allowed.begin(), allowed.end(),
                                      [&](const fs::path& root) { return is_below(path, root); });
    if (!may_read) continue;
    const FileIdentity before = identify(path.string());
    Diagnostics unsaid;  // There are other folders.
    if (std::optional<std::string> text = read_file(path.string(), max_file_bytes, unsaid)) {
      files.emplace(path.string(), before);
      return glsl::Sources::File{path.string(), std::move(*text)};
    }
  }
  return std::nullopt;
}

/// "{{in1}}" as the name "__in1__", of one length, so that columns stay right.
std::string with_names(std::string text) {
  for (std::size_t at = text.find("{{"); at != std::string::npos; at = text.find("{{", at)) {
    const std::size_t end = text.find("}}", at);
    if (end == std::string::npos) break;
    text.replace(at, 2, "__");
    text.replace(end, 2, "__");
  }
  return text;
}

}  // namespace

TextModules::TextModules(std::vector<fs::path> roots)
    : roots_(std::move(roots)), prelude_(glsl::Prelude::read()) {}

bool TextModules::Entry::is_current() const {
  return std::all_of(files.begin(), files.end(),
                     [](const auto& file) { return identify(file.first) == file.second; });
}

std::shared_ptr<const glsl::Module> TextModules::find(const NodeText& source,
                                                      Diagnostics& diagnostics, const Stop& stop) {
  // What is said of a file's text names the file, wherever it is used.
  const bool is_inline = source.file.empty();
  Key key{source.function.empty(),
          source.document,
          source.file,
          source.text,
          is_inline ? source.where.file : "",
          is_inline ? source.where.line : 0};
  const std::lock_guard lock(mutex_);
  const auto found = modules_.find(key);
  if (found != modules_.end() && found->second.is_current()) return found->second.module;
  Entry entry = read(source, diagnostics, stop);
  // A faulty text is read again, to complain again.
  if (entry.module == nullptr) return nullptr;
  return modules_.insert_or_assign(std::move(key), std::move(entry)).first->second.module;
}

TextModules::Entry TextModules::read(const NodeText& source, Diagnostics& diagnostics,
                                     const Stop& stop) const {
  Entry entry;
  const fs::path home = fs::path(source.document).parent_path();
  std::vector<fs::path> allowed{home};
  allowed.insert(allowed.end(), roots_.begin(), roots_.end());
  glsl::PreprocessOptions options;
  options.stop = stop;
  options.find_include = [&](const std::string& name, const std::string& from) {
    std::vector<fs::path> folders{fs::path(from).parent_path()};
    folders.insert(folders.end(), allowed.begin(), allowed.end());
    return find_file(name, folders, allowed, entry.files);
  };
  const std::string& where = source.where.file;
  const int line = source.where.line;
  if (source.file.empty() && source.function.empty()) {
    entry.module = glsl::Module::read_expression(prelude_, {where, with_names(source.text), line},
                                                 diagnostics, stop);
  } else if (source.file.empty()) {
    entry.module = glsl::Module::read(prelude_, {where, source.text, line}, options, diagnostics);
  } else if (source.function.empty()) {
    diagnostics.error("source-misfit", source.where,
                      "the implementation names a file but no function", "an attribute 'function'",
                      "none");
  } else if (std::optional<glsl::Sources::File> file =
                 find_file(source.file, allowed, allowed, entry.files)) {
    entry.module = glsl::Module::read(prelude_, std::move(*file), options, diagnostics);
  } else {
    diagnostics.error("missing-source", source.where,
                      "the file of the implementation was not found",
                      "a file below the document's folder or a library's", source.file);
  }
  return entry;
}

}  // namespace nacre
