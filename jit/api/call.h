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
  mutable std::vector<std::string> lines;  ///< Made when asked for; of `said`, in its order.
};

namespace nacre::api {

/// Runs `body`, which gives a status.
template <class Body>
nacre_status guarded(Body&& body) noexcept {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return NACRE_OUT_OF_MEMORY;
  } catch (const std::exception&) {
    return NACRE_FAILED;
  }
}

/// The diagnostics of a call, with or without somebody who reads them.
class Said {
 public:
  explicit Said(nacre_report* report)
      : said_(report != nullptr ? report->said : own_), errors_before_(said_.error_count()) {}
  Diagnostics& diagnostics() { return said_; }
  /// Whether there are errors of this call.
  bool has_errors() const { return said_.error_count() != errors_before_; }

 private:
  Diagnostics own_;
  Diagnostics& said_;
  std::size_t errors_before_;
};

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
