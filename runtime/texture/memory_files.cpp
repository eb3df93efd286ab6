#include "runtime/texture/memory_files.h"

namespace nacre {

std::shared_ptr<const MemoryFile> MemoryFiles::keep(std::string_view bytes) {
  const Digest digest = sha256(bytes);
  const std::scoped_lock lock(mutex_);
  std::erase_if(files_, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<const MemoryFile>& known = files_[digest];
  std::shared_ptr<const MemoryFile> file = known.lock();
  if (file == nullptr) {
    file = MemoryFile::create(bytes);
    known = file;
  }
  return file;
}

}  // namespace nacre
