// A module of another build, and one of this build in a file of another name.
#include "runtime/module.h"

const nacre::ModuleHead* nacre_module() {
  static constexpr nacre::ModuleHead head{BUILD_KEY, "test_foreign_module"};
  return &head;
}
