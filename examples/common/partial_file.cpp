#include "examples/common/partial_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace nacre::host {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".nacre-";
constexpr std::string_view random_part = "-XXXXXX";
constexpr std::size_t boot_size = 8;

/// What another machine has left is swept only if nothing was written there for so long.
constexpr auto patience = std::chrono::hours(1);

/// Names this machine since it was started: disks that machines share may have locks that they do
/// not share (NFS with local_lock), which say nothing of a process elsewhere.
const std::string& boot() {
  static const std::string* const name = new std::string([] {
    std::ifstream file("/proc/sys/kernel/random/boot_id");
    std::string id;
    file >> id;
    id.resize(boot_size, '0');
    return id;
  }());
  return *name;
}

/// The folders of this process's partial files. One set for the process, because it is the
/// process that is killed and has to leave nothing behind.
struct Living {
  std::timed_mutex mutex;
  std::set<std::string> folders;
};

Living& living() {
  static Living* const all = new Living;  // Never destroyed: threads may outlive main().
  return *all;
}

std::string last_error() { return std::generic_category().message(errno); }

struct Lock {
  int file = -1;         ///< The folder, open and locked, or -1:
  bool is_gone = false;  ///< somebody else has it, or has removed it.
};

Lock lock_folder(const std::string& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return {.file = -1, .is_gone = errno == ENOENT};
  const bool locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  bool is_gone = !locked && errno == EWOULDBLOCK;
  struct stat status{};
  if (locked && ::fstat(file, &status) == 0 && status.st_uid == ::geteuid()) {
    // Who swept between our opening and our locking has removed it: no links are left.
    if (status.st_nlink > 0) return {.file = file, .is_gone = false};
    is_gone = true;
  }
  ::close(file);
  return {.file = -1, .is_gone = is_gone};
}

/// Names in `folder` that a partial file may have.
std::vector<std::string> candidates(const std::string& folder) {
  std::vector<std::string> names;
  DIR* stream = ::opendir(folder.c_str());
  if (stream == nullptr) return names;
  while (const dirent* entry = ::readdir(stream)) {
    const std::string_view name = entry->d_name;
    const bool fits =
        name.starts_with(prefix) && name.size() == prefix.size() + boot_size + random_part.size();
    if (fits) names.emplace_back(name);
  }
  ::closedir(stream);
  return names;
}

/// Whether nothing in a folder was written for a while.
bool is_idle(const std::string& folder) {
  const auto now = fs::file_time_type::clock::now();
  std::error_code error;
  if (now - fs::last_write_time(folder, error) < patience || error) return false;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (now - fs::last_write_time(entry, error) < patience || error) return false;
  }
  return !error;
}

/// Why a file of that path cannot come to be, as far as can be told beforehand, or "".
std::string obstacle(const std::string& path) {
  const fs::path name = fs::path(path).filename();
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) return last_error();
    return name.empty() || name == "." || name == ".." ? "this is no name of a file" : "";
  }
  if (S_ISREG(status.st_mode)) return {};
  return S_ISDIR(status.st_mode) ? "there is a folder of that name" : "this is no regular file";
}

/// Data reach the disk before the name does.
std::string sync_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return last_error();
  const std::string problem = ::fsync(file) == 0 ? "" : last_error();
  ::close(file);
  return problem;
}

}  // namespace

void sweep_partial_files(const std::string& folder) {
  for (const std::string& name : candidates(folder)) {
    const std::string left = (fs::path(folder) / name).string();
    const Lock lock = lock_folder(left);
    if (lock.file < 0) continue;
    const bool is_ours = name.compare(prefix.size(), boot_size, boot()) == 0;
    std::error_code ignored;
    if (is_ours || is_idle(left)) fs::remove_all(left, ignored);
    ::close(lock.file);
  }
}

PartialFile::PartialFile(std::string path) : path_(std::move(path)) {
  problem_ = obstacle(path_);
  if (!problem_.empty()) return;
  const fs::path parent = fs::path(path_).parent_path();
  const std::string beside = parent.empty() ? "." : parent.string();
  sweep_partial_files(beside);
  Living& all = living();
  const std::scoped_lock guard(all.mutex);
  Lock lock;
  do {  // Another process may take a new folder for left over before it is locked.
    const std::string name = std::string(prefix) + boot() + std::string(random_part);
    folder_ = (fs::path(beside) / name).string();
    if (::mkdtemp(folder_.data()) == nullptr) {
      problem_ = last_error();
      folder_.clear();
      return;
    }
    lock = lock_folder(folder_);
  } while (lock.is_gone);
  lock_ = lock.file;  // Where nothing can be locked nobody can take it for left over either.
  all.folders.insert(folder_);
  name_ = (fs::path(folder_) / fs::path(path_).filename()).string();
}

PartialFile::~PartialFile() {
  if (!folder_.empty()) remove();
}

std::string PartialFile::commit() {
  std::string problem = sync_file(name_);
  if (problem.empty()) {
    const std::scoped_lock lock(living().mutex);
    std::error_code status;
    fs::rename(name_, path_, status);
    if (status) problem = status.message();
  }
  remove();
  return problem;
}

void PartialFile::remove() {
  Living& all = living();
  const std::scoped_lock lock(all.mutex);
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  all.folders.erase(folder_);
  if (lock_ >= 0) ::close(lock_);
  lock_ = -1;
  folder_.clear();
}

void abandon_partial_files() {
  Living& all = living();
  // And stays locked. Who fails to free it, having run out of memory just there, is not
  // waited for; the next run sweeps then.
  if (!all.mutex.try_lock_for(std::chrono::seconds(1))) return;
  std::error_code ignored;
  for (const std::string& folder : all.folders) {
    // A thread that still writes may add a file while the others are removed.
    for (int i = 0; i < 3 && fs::exists(folder, ignored); ++i) fs::remove_all(folder, ignored);
  }
}

}  // namespace nacre::host
