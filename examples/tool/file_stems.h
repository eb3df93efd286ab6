#pragma once

#include <set>
#include <string>
#include <string_view>

#include "runtime/diagnostic.h"

namespace nacre::tool {

/// Names of files for what documents name: a document chooses neither the folder nor a
/// name that no file system takes.
class FileStems {
 public:
  /// "NG_marble/out" becomes "NG_marble.out": '/' and ':' are dots, what is no letter, digit
  /// or one of "_-." an underscore, as a dot at the beginning is; at most 200 bytes. Where
  /// that is taken already it gets a number, with a warning.
  std::string stem_of(std::string_view name, const SourceLocation& where, Diagnostics& diagnostics);

 private:
  std::set<std::string> taken_;
};

}  // namespace nacre::tool
