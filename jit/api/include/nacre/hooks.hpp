/// \file
/// What a host may do in place of the library: part of <nacre/nacre.hpp>.
#ifndef NACRE_HOOKS_HPP
#define NACRE_HOOKS_HPP

#include <cstddef>
#include <functional>
#include <memory>
#include <memory_resource>
#include <nacre/diagnostic.hpp>
#include <optional>
#include <string>
#include <utility>

namespace nacre {
inline namespace v0 {

/// Where a file is; see nacre_file.
struct File {
  std::string path;                  ///< Of contents in memory what they are called.
  std::optional<std::string> bytes;  ///< The contents, where they are in memory.
};
/// Called with the name, the document that has it, and NACRE_INCLUDE or NACRE_IMAGE. Nothing: the
/// file is looked for as usual.
using FileResolver = std::function<std::optional<File>(const std::string& name,
                                                       const std::string& named_by, int what)>;

/// An image that the host looks up itself.
class HostImage {
 public:
  virtual ~HostImage() = default;
  virtual int width() const = 0;   ///< In pixels.
  virtual int height() const = 0;  ///< In pixels.
  /// Red, green, blue and alpha into four arrays of lookup.count; does not throw.
  virtual void look_up(const nacre_texture_lookup& lookup, float* const* rgba) const noexcept = 0;
};
/// Called with the name, resolved, and layer of an image. Null: it is read as a file.
using TextureSystem =
    std::function<std::unique_ptr<HostImage>(const std::string& name, const std::string& layer)>;

/// Has the task run soon, by some thread of the host's; see nacre_executor.
using Executor = std::function<void(std::function<void()> task)>;

/// Pixels in memory; see nacre_image.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  int samples = NACRE_UINT8;
  const void* pixels = nullptr;
  std::ptrdiff_t row_bytes = 0;
};

namespace detail {

template <class T>
void destroy_copy(void* user) {
  delete static_cast<T*>(user);
}

inline int resolve_file(void* user, const char* name, const char* named_by, int what,
                        nacre_file* file) {
  static thread_local File kept;  // Until the thread asks again.
  try {
    std::optional<File> found = (*static_cast<FileResolver*>(user))(name, named_by, what);
    if (!found) return 0;
    kept = std::move(*found);
    file->path = kept.path.c_str();
    file->bytes = kept.bytes ? kept.bytes->data() : nullptr;
    file->byte_count = kept.bytes ? kept.bytes->size() : 0;
    return 1;
  } catch (...) {
    return 0;
  }
}

/// Of a copy, which `destroy` deletes.
inline nacre_file_resolver resolver_of(const FileResolver& resolver) {
  return {sizeof(nacre_file_resolver), new FileResolver(resolver), resolve_file,
          destroy_copy<FileResolver>};
}

inline int open_image(void* user, const char* name, const char* layer, nacre_opened_image* opened) {
  try {
    std::unique_ptr<HostImage> image = (*static_cast<TextureSystem*>(user))(name, layer);
    if (image == nullptr) return 0;
    opened->width = image->width();
    opened->height = image->height();
    opened->image = image.release();
    return 1;
  } catch (...) {
    return 0;
  }
}

inline nacre_texture_system texture_system_of(const TextureSystem& textures) {
  nacre_texture_system made{};
  made.size = sizeof made;
  made.user = new TextureSystem(textures);
  made.open = open_image;
  made.look_up = [](void*, void* image, const nacre_texture_lookup* lookup, float* const* rgba) {
    static_cast<const HostImage*>(image)->look_up(*lookup, rgba);
  };
  made.close = [](void*, void* image) { delete static_cast<HostImage*>(image); };
  made.destroy = destroy_copy<TextureSystem>;
  return made;
}

inline nacre_executor executor_of(const Executor& executor) {
  nacre_executor made{};
  made.size = sizeof made;
  made.user = new Executor(executor);
  made.submit = [](void* user, void (*run)(void*), void* task) {
    (*static_cast<Executor*>(user))([run, task] { run(task); });
  };
  made.destroy = destroy_copy<Executor>;
  return made;
}

/// The resource must live as long as anything that was made with it.
inline nacre_allocator allocator_of(std::pmr::memory_resource* memory) {
  nacre_allocator made{};
  made.size = sizeof made;
  made.user = memory;
  made.allocate = [](void* user, std::size_t bytes) -> void* {
    try {
      return static_cast<std::pmr::memory_resource*>(user)->allocate(bytes, 64);
    } catch (...) {
      return nullptr;
    }
  };
  made.release = [](void* user, void* block, std::size_t bytes) {
    static_cast<std::pmr::memory_resource*>(user)->deallocate(block, bytes, 64);
  };
  return made;
}

}  // namespace detail

}  // namespace v0
}  // namespace nacre

#endif
