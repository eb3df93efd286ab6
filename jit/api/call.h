#pragma once

#include <nacre/nacre.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "runtime/diagnostic.h"

/// What the functions of nacre.h have in common: no exception leaves them, structures are as
/// long as the host's version of them, and what is said goes to the host's report.

/// Diagnostics and their one-line texts, which the host may look at.
struct nacre_report {
  nacre::Diagnostics said;
  void (*listener)(void* user, const nacre_diagnostic* diagnostic) = nullptr;
  void* listener_user = nullptr;
  mutable std::vector<std::string> lines;  ///< Made when asked for; of `said`, in its order.
};

namespace nacre::api {

/// Tells who listens to a report of its diagnostics from the one with this index on.
void tell_listener(const nacre_report* report, std::size_t first) noexcept;

/// Says in a report, if there is one, what was thrown that nobody thought of.
void say_thrown(nacre_report* report, const char* what) noexcept;

/// Runs `body`, which gives a status. What it throws is said in `report`, which may be null.
template <class Body>
nacre_status guarded(nacre_report* report, Body&& body) noexcept {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return NACRE_OUT_OF_MEMORY;
  } catch (const std::exception& thrown) {
    say_thrown(report, thrown.what());
  } catch (...) {
    say_thrown(report, "something that is no exception");
  }
  return NACRE_FAILED;
}
template <class Body>
nacre_status guarded(Body&& body) noexcept {
  return guarded(nullptr, std::forward<Body>(body));
}

/// The diagnostics of a call, with or without somebody who reads them.
class Said {
 public:
  explicit Said(nacre_report* report)
      : report_(report),
        said_(report != nullptr ? report->said : own_),
        before_(said_.all().size()),
        errors_before_(said_.error_count()) {}
  ~Said() { tell_listener(report_, before_); }
  Said(const Said&) = delete;
  Said& operator=(const Said&) = delete;
  Diagnostics& diagnostics() { return said_; }
  /// Whether there are errors of this call.
  bool has_errors() const { return said_.error_count() != errors_before_; }

 private:
  nacre_report* report_;
  Diagnostics own_;
  Diagnostics& said_;
  std::size_t before_;
  std::size_t errors_before_;
};

/// Whether a structure says how long it is; one that is not there need not.
template <class Structure>
bool has_size(const Structure* given) {
  return given == nullptr || given->size >= sizeof given->size;
}

/// The host's options, with what its version of them does not have being 0.
template <class Options>
Options options_of(const Options* given) {
  Options options{};
  if (given != nullptr) std::memcpy(&options, given, std::min(given->size, sizeof options));
  return options;
}

/// Fills in as much of a structure as the host's version of it has.
template <class Structure>
nacre_status give(Structure* to, Structure from) {
  if (to == nullptr || to->size < sizeof to->size) return NACRE_WRONG_ARGUMENTS;
  from.size = std::min(to->size, sizeof from);
  std::memcpy(to, &from, from.size);
  return NACRE_OK;
}

/// A host's list of texts; null ones are left out.
std::vector<std::string> texts_of(const char* const* texts, std::size_t count);

/// "" for null.
inline const char* text_or_empty(const char* text) { return text != nullptr ? text : ""; }

}  // namespace nacre::api
