#pragma once

#include <stop_token>

namespace nacre::tool {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM requests a stop instead
/// of ending the program, so that nothing is left half-written; the second ends it.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
  std::stop_token token() const;
};

}  // namespace nacre::tool
