#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace nacre {

/// Numbers and texts one after another, for a process of this machine. Every text and list
/// is preceded by its length.
class BytesOut {
 public:
  template <class T>
  void add(T value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  void add_text(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  template <class T>
  void add_list(const std::vector<T>& list) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_text({reinterpret_cast<const char*>(list.data()), sizeof(T) * list.size()});
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads them again; once something is not there, everything else is zero or empty and
/// `is_whole` false.
class BytesIn {
 public:
  explicit BytesIn(std::string_view bytes) : left_(bytes) {}

  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    const std::string_view bytes = take_bytes(sizeof(T));
    if (bytes.size() == sizeof(T)) std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
  std::string_view take_text() { return take_bytes(take<std::uint64_t>()); }
  template <class T>
  std::vector<T> take_list() {
    const std::string_view bytes = take_text();
    if (bytes.size() % sizeof(T) != 0) failed_ = true;
    std::vector<T> list(failed_ ? 0 : bytes.size() / sizeof(T));
    if (!list.empty()) std::memcpy(list.data(), bytes.data(), bytes.size());
    return list;
  }
  /// The number of elements that follow, of at least `each` bytes.
  std::size_t take_count(std::size_t each) {
    const auto count = take<std::uint64_t>();
    if (count > left_.size() / each) failed_ = true;
    return failed_ ? 0 : static_cast<std::size_t>(count);
  }

  /// Whether everything was there, and nothing else.
  bool is_whole() const { return !failed_ && left_.empty(); }

 private:
  std::string_view take_bytes(std::uint64_t size) {
    failed_ = failed_ || size > left_.size();
    if (failed_) return {};
    const std::string_view bytes = left_.substr(0, static_cast<std::size_t>(size));
    left_.remove_prefix(bytes.size());
    return bytes;
  }

  std::string_view left_;
  bool failed_ = false;
};

}  // namespace nacre
