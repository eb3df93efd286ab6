#pragma once

#include <cstddef>
#include <map>
#include <memory>

namespace nacre {

class CodeSlab;

/// Pages of one kernel: some for its code and some for its constants, near each other.
struct CodePages {
  CodeSlab* slab = nullptr;  ///< Null: none.
  char* code = nullptr;
  std::size_t code_pages = 0;
  char* data = nullptr;
  std::size_t data_pages = 0;
};

/// One mapping: executable pages from its start on, read-only ones from its end on and
/// where nothing is yet. So at rest the system sees two areas, however many kernels there
/// are; a kernel that is being written is one or two more.
class CodeSlab {
 public:
  enum class State {
    writable,  ///< Not executable.
    finished,  ///< Code can be executed and read, constants can be read.
  };

  /// At least this many pages; null if the system refuses.
  static std::unique_ptr<CodeSlab> create(std::size_t pages);
  ~CodeSlab();
  CodeSlab(const CodeSlab&) = delete;
  CodeSlab& operator=(const CodeSlab&) = delete;

  /// Pages full of zeros; false if there is no room.
  bool take(std::size_t code, std::size_t data, CodePages& pages);
  /// False if the system refuses.
  bool protect(const CodePages& pages, State state);
  /// Their memory goes back to the system. They must be finished.
  void give_back(const CodePages& pages);
  bool is_unused() const { return used_ == 0; }

  static std::size_t page_size();

 private:
  using Runs = std::map<std::size_t, std::size_t>;  ///< Pages by the first one's number.

  CodeSlab(char* base, std::size_t pages) : base_(base), pages_(pages), data_begin_(pages) {}
  bool set(const char* start, std::size_t pages, int protection);
  void give_back(Runs& runs, const char* start, std::size_t pages);

  char* base_;
  std::size_t pages_;
  std::size_t code_end_ = 0;  ///< Pages before it are or were code.
  std::size_t data_begin_;    ///< Pages from it on are or were constants.
  Runs free_code_, free_data_;
  std::size_t used_ = 0;
};

}  // namespace nacre
