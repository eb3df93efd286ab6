#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nacre {

/// A file descriptor, closed at the end of its life.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }
  int release();
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

/// Why what a descriptor refers to is not to be trusted, or "": it must belong to
/// the effective user, be writable by nobody else, and be a folder or a regular
/// file as asked.
std::string distrust(int descriptor, bool folder);

/// All bytes of a file in a folder, touched as just used. Nothing if there is no
/// such file; `fault` says so if there is one that is not to be trusted or is
/// larger than `largest`.
std::optional<std::string> read_trusted(int folder, const std::string& name, std::uint64_t largest,
                                        std::string& fault);

/// Writes a file that must not exist, for the owner alone. False, with errno, if that
/// failed; then there is none.
bool write_new(int folder, const std::string& name, std::string_view bytes);

/// Writes a file that appears whole: one without a name that gets it, so that nothing is
/// left if the process is killed; where the file system has no such files or the name is
/// taken, under a temporary name first. False if that failed.
bool write_and_rename(int folder, const std::string& name, const std::string& temporary,
                      std::string_view bytes);

/// Bytes of all kernels in a folder. Removes what is left of interrupted writes,
/// then the least recently used kernels until the sum is at most `limit`.
std::uint64_t sweep(int folder, std::uint64_t limit);

/// What temporary names start with.
inline constexpr std::string_view temporary_prefix = ".writing-";
/// What names of kernels end with. Other files are left alone.
inline constexpr std::string_view kernel_suffix = ".kernel";

}  // namespace nacre
