#pragma once

#include <algorithm>
#include <set>
#include <string>

#include "examples/tool/options.h"
#include "examples/tool/report.h"

namespace nacre::tool {

/// Says what comes up while many things are made alike, each thing once.
class ReportOnce {
 public:
  /// Of all of it so far, what is new.
  void say(const Diagnostics& diagnostics) {
    Diagnostics fresh;
    for (const Diagnostic& each : diagnostics.all()) {
      if (said_.insert(each.to_string()).second) fresh.add(each);
    }
    status_ = std::max<int>(status_, report(fresh));
  }
  /// For what has failed without a word.
  void fail() { status_ = std::max<int>(status_, status_problems); }
  /// The worst that it meant.
  int status() const { return status_; }

 private:
  std::set<std::string> said_;
  int status_ = status_ok;
};

}  // namespace nacre::tool
