#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace nacre {

/// What a document names a file for.
enum class FileKind { include, image };

/// Where a file is that a document names.
struct ResolvedFile {
  std::string path;  ///< To be read, wherever it lies; of contents in memory what they are called.
  /// The contents; null: those of the file.
  std::shared_ptr<const std::string> bytes = nullptr;
};

/// Where files are that a host has: in an archive, an asset system. `name` as the document has it,
/// `named_by` the document's own. Nothing: it is looked for as usual. Called by any thread.
using FileResolver = std::function<std::optional<ResolvedFile>(
    const std::string& name, const std::string& named_by, FileKind kind)>;

}  // namespace nacre
