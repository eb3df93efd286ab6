#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "jit/glsl/module.h"
#include "jit/graph/graph.h"
#include "runtime/diagnostic.h"
#include "runtime/stop.h"
#include "runtime/texture/file_identity.h"

namespace nacre {

/// The texts of implementations, each read once for as long as the files that it comes from
/// stay as they are. May be used from any thread.
class TextModules {
 public:
  /// `roots`: folders in which files are looked for after the folder of the including file
  /// and that of the document. Nothing outside the roots and the document's folder is read.
  explicit TextModules(std::vector<std::filesystem::path> roots);
  const std::vector<std::filesystem::path>& roots() const { return roots_; }

  /// The source's text: an expression where it names no function, else what defines that
  /// function. Null, with a diagnostic, for one that cannot be read.
  std::shared_ptr<const glsl::Module> find(const NodeText& source, Diagnostics& diagnostics,
                                           const Stop& stop);

 private:
  /// What decides how a text is read, and what is said of it while it is recorded.
  struct Key {
    bool is_expression = false;
    std::string document, file, text;
    std::string where;
    int line = 0;

    auto operator<=>(const Key&) const = default;
  };

  /// What was read, and the files that it was read from, as they were before.
  struct Entry {
    std::shared_ptr<const glsl::Module> module;
    std::map<std::string, FileIdentity> files;

    bool is_current() const;
  };

  Entry read(const NodeText& source, Diagnostics& diagnostics, const Stop& stop) const;

  const std::vector<std::filesystem::path> roots_;
  const std::shared_ptr<const glsl::Prelude> prelude_;
  std::mutex mutex_;
  std::map<Key, Entry> modules_;
};

}  // namespace nacre
