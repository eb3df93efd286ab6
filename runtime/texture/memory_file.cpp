#include "runtime/texture/memory_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

namespace nacre {

MemoryFile::MemoryFile(int descriptor)
    : descriptor_(descriptor), path_(fmt::format("/proc/self/fd/{}", descriptor)) {}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::shared_ptr<const MemoryFile> MemoryFile::create(std::string_view bytes) {
  const int descriptor = ::memfd_create("nacre", MFD_CLOEXEC);
  if (descriptor < 0) return nullptr;
  std::shared_ptr<const MemoryFile> file(new MemoryFile(descriptor));
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return nullptr;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return file;
}

}  // namespace nacre
