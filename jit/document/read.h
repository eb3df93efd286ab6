#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jit/document/document.h"
#include "jit/document/file_resolver.h"
#include "runtime/diagnostic.h"
#include "runtime/stop.h"

namespace nacre {

/// What a document may cost, so that no file can exhaust the machine.
struct ReadLimits {
  std::size_t file_bytes = std::size_t{64} << 20;    ///< Of one file.
  std::size_t total_bytes = std::size_t{256} << 20;  ///< Of all files of the document.
  int files = 1024;                                  ///< All that are read, the main one counted.
  int include_depth = 256;                           ///< Files that include one another.
  int xml_depth = 256;                               ///< Elements within one another.
  std::size_t elements = 4'000'000;                  ///< In one file.
  /// Of nodedefs, instances, looks and types that inherit from one another: each chain,
  /// both ends counted. Kept by the document for whoever follows them.
  std::size_t inheritance = 64;
};

/// How a document is read.
struct ReadOptions {
  /// Where includes are looked for after the including file's own folder.
  std::vector<std::filesystem::path> search_paths;
  /// Includes must lie below the main file's folder or a search path, whatever
  /// ".." and symbolic links say. True lifts that.
  bool includes_anywhere = false;
  /// Keep comments, processing instructions, text and blank lines for
  /// `write_document`. Elements are the same without.
  bool keep_comments = false;
  ReadLimits limits;      ///< Exceeding one is an error.
  FileResolver resolver;  ///< Asked for includes before they are looked for; null: none.
  Stop stop;              ///< Ends reading early, as an error.
};

/// Reads a document and all it includes. Nothing if there was an error; the
/// diagnostics then say what. An included document's elements stand before the
/// including one's own, and of two elements of one name the included one
/// stays (MaterialX Specification, "MTLX File Format").
std::unique_ptr<Document> read_document(const std::filesystem::path& file,
                                        const ReadOptions& options, Diagnostics& diagnostics);

/// The same for text in memory. `name` stands for the file in diagnostics, and
/// its folder is where includes are looked for.
std::unique_ptr<Document> read_document_text(std::string_view text, const std::string& name,
                                             const ReadOptions& options, Diagnostics& diagnostics);

/// Several files as one document, in order, and then texts, by name and content; of two root
/// elements of one name the first stays. For data libraries.
std::unique_ptr<Document> read_documents(
    const std::vector<std::filesystem::path>& files,
    const std::vector<std::pair<std::string_view, std::string_view>>& texts,
    const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace nacre
