#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string_view>

#include "runtime/digest.h"
#include "runtime/texture/memory_file.h"

namespace nacre {

/// One file in memory for all that have the same bytes, as long as somebody holds it. All members
/// may be called by any thread.
class MemoryFiles {
 public:
  /// Null, with errno, where the system has no room for it.
  std::shared_ptr<const MemoryFile> keep(std::string_view bytes);

 private:
  std::mutex mutex_;
  std::map<Digest, std::weak_ptr<const MemoryFile>> files_;
};

}  // namespace nacre
