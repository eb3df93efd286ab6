#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "jit/llvm/codegen.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Compiled kernels in a folder, one file each. What is in there gets executed,
/// so it must be as trustworthy as the program itself: the folder and its files
/// have to belong to the effective user and be writable by nobody else, links
/// are not followed, and a file counts only if its whole key and its signature are
/// right, made with a secret that lies in the folder for the user's eyes only. Whatever
/// is doubtful is a miss, and the first time also a warning "kernel-cache".
///
/// Any number of threads and processes may use one folder at once: files appear
/// by renaming. The least recently used go when the sum of sizes passes a limit.
class KernelCache {
 public:
  static constexpr std::uint64_t default_limit = 1ull << 30;  ///< Bytes.

  /// Opens or creates (mode 0700, with its parents) the folder. Null, with a
  /// warning, if it can't be had or can't be trusted.
  static std::unique_ptr<KernelCache> open(const std::filesystem::path& folder,
                                           Diagnostics& diagnostics,
                                           std::uint64_t limit = default_limit);
  ~KernelCache();
  /// The same folder for a child of fork(), which must not use this any more. Null if
  /// there are no more file descriptors.
  std::unique_ptr<KernelCache> reopened() const;
  KernelCache(const KernelCache&) = delete;
  KernelCache& operator=(const KernelCache&) = delete;

  /// The object stored under exactly this key, or nothing; nothing also if it is not for
  /// this `interface` (see ObjectCode).
  std::optional<ObjectCode> load(const std::string& key, const std::string& interface,
                                 Diagnostics& diagnostics);
  /// Stores it. Failing (disk full, read-only) is a warning, and the last attempt.
  void store(const std::string& key, const ObjectCode& object, Diagnostics& diagnostics);

  /// The name of the file for a key, without its folder.
  static std::string file_name(const std::string& key);

 private:
  KernelCache(int folder, std::string secret, std::uint64_t limit)
      : folder_(folder), secret_(std::move(secret)), limit_(limit) {}
  void warn(Diagnostics& diagnostics, const std::string& message, const std::string& file);
  void grow(std::uint64_t bytes);

  int folder_;  ///< Descriptor: what happens to the path later does not matter.
  const std::string secret_;
  const std::uint64_t limit_;
  std::mutex mutex_;
  std::optional<std::uint64_t> total_;  ///< Bytes in the folder, about.
  std::atomic<bool> warned_ = false;
  std::atomic<bool> read_only_ = false;
  std::atomic<std::uint64_t> number_ = 0;
};

/// $XDG_CACHE_HOME/nacre, or ~/.cache/nacre; empty if neither is known (XDG Base
/// Directory Specification 0.8: a relative value is ignored).
std::filesystem::path default_cache_folder();

}  // namespace nacre
