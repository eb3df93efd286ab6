#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "examples/image_input/graph_output.h"

namespace graph_image {

/// A file as it was when it was read.
struct FileStamp {
  std::filesystem::path file;
  std::filesystem::file_time_type modified = {};
  std::uintmax_t bytes = 0;

  bool operator==(const FileStamp&) const = default;
};

/// An output, ready to be shaded, and what there was to say of it.
struct ReadyOutput {
  std::unique_ptr<const GraphOutput> output;
  GraphInfo info;
  std::vector<FileStamp> files;  ///< The document, what it includes, and the profile.
};

/// Outputs that were compiled, for all who open the same image: OpenImageIO opens a file anew
/// whenever it has closed it to have others open, and once for each thread in some programs. Any
/// thread may ask. Holds the `most` outputs that were asked for last; what somebody still has
/// lives on.
class OutputStore {
 public:
  explicit OutputStore(std::size_t most) : most_(most) {}

  /// Made if it is not there, or if one of its files has changed since; the others wait who want
  /// the same. Throws Wrong and nacre::Error, which are not remembered.
  std::shared_ptr<const ReadyOutput> get(const Request& request);

 private:
  struct Entry;

  std::shared_ptr<Entry> entry_of(const Request& request);
  nacre::System& system();

  const std::size_t most_;
  std::mutex system_mutex_;
  std::optional<nacre::System> system_;
  std::vector<nacre::Diagnostic> system_said_;  ///< Of making it; as it is from then on.
  std::mutex mutex_;                            ///< Of the list.
  std::list<std::shared_ptr<Entry>> entries_;   ///< What was asked for last comes first.
};

/// The one store of the process, which goes when the process ends. OpenImageIO makes its readers
/// by a function without arguments and hands them nothing that they could share, so a plug-in has
/// no other place for what outlives one of them; without it every look-up of a closed file would
/// compile its graph again.
OutputStore& shared_store();

}  // namespace graph_image
