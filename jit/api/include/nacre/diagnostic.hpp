/// \file
/// What there is to say, and errors as exceptions: part of <nacre/nacre.hpp>.
#ifndef NACRE_DIAGNOSTIC_HPP
#define NACRE_DIAGNOSTIC_HPP

#include <nacre/nacre.h>

#include <cstddef>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {

/// One complaint about a document, an image, a channel; see nacre_diagnostic.
struct Diagnostic {
  int severity = NACRE_ERROR;
  std::string code;
  std::string file;
  int line = 0;
  int column = 0;
  std::string path;
  std::string message;
  std::string expected;
  std::string found;
  std::string text;  ///< All of it in one line.
  std::string hint;  ///< Which names will have been meant by one that there is not.
};

/// What was asked for is not there: carries everything that was said.
class Error : public std::runtime_error {
 public:
  Error(nacre_status status, std::vector<Diagnostic> said)
      : std::runtime_error(text_of(status, said)), status_(status), said_(std::move(said)) {}
  nacre_status status() const { return status_; }
  const std::vector<Diagnostic>& diagnostics() const { return said_; }

 private:
  static std::string text_of(nacre_status status, const std::vector<Diagnostic>& said) {
    std::string text;
    for (const Diagnostic& each : said) {
      if (!text.empty()) text += '\n';
      text += each.text;
    }
    if (!text.empty()) return text;
    return status == NACRE_WRONG_ARGUMENTS ? "nacre: wrong arguments"
                                           : "nacre: status " + std::to_string(status);
  }
  nacre_status status_;
  std::vector<Diagnostic> said_;
};

namespace detail {

inline const char* text_or_null(const std::string& text) {
  return text.empty() ? nullptr : text.c_str();
}

/// An object of the library, destroyed with its last owner.
template <class T, void (*destroy)(T*)>
struct Destroy {
  void operator()(T* object) const { destroy(object); }
};
template <class T, void (*destroy)(T*)>
using Owned = std::unique_ptr<T, Destroy<T, destroy>>;

inline void check(nacre_status status) {
  if (status == NACRE_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status != NACRE_OK) throw Error(status, {});
}

/// Texts as the C interface takes them; refers to them.
class TextList {
 public:
  explicit TextList(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) list_.push_back(text.c_str());
  }
  const char* const* data() const { return list_.data(); }
  std::size_t size() const { return list_.size(); }

 private:
  std::vector<const char*> list_;
};

/// The report of one call: errors are thrown, warnings and notes go to the host's list.
class Said {
 public:
  Said() {
    nacre_report* made = nullptr;
    check(nacre_report_create(&made));
    report_.reset(made);
  }
  nacre_report* get() const { return report_.get(); }

  std::vector<Diagnostic> all() const {
    std::vector<Diagnostic> list;
    for (std::size_t i = 0; i < nacre_report_count(get()); ++i) {
      nacre_diagnostic one{};
      one.size = sizeof one;
      check(nacre_report_get(get(), i, &one));
      list.push_back({one.severity, one.code, one.file, one.line, one.column, one.path, one.message,
                      one.expected, one.found, one.text, one.hint});
    }
    return list;
  }

  /// Throws unless `status` is NACRE_OK; else what there is to say goes to `said`, if anybody
  /// wants it.
  void finish(nacre_status status, std::vector<Diagnostic>* said) const {
    if (status == NACRE_OUT_OF_MEMORY) throw std::bad_alloc();
    if (status != NACRE_OK) throw Error(status, all());
    if (said == nullptr) return;
    for (Diagnostic& each : all()) said->push_back(std::move(each));
  }

 private:
  Owned<nacre_report, nacre_report_destroy> report_;
};

}  // namespace detail

/// Ends long calls early: requested by any thread, once and for all.
class StopSource {
 public:
  StopSource() {
    nacre_stop* made = nullptr;
    detail::check(nacre_stop_create(&made));
    stop_.reset(made);
  }
  void request() { nacre_stop_request(get()); }
  nacre_stop* get() const { return stop_.get(); }

 private:
  detail::Owned<nacre_stop, nacre_stop_destroy> stop_;
};

}  // namespace v0
}  // namespace nacre

#endif
