#pragma once

#include <string>

namespace nacre {

/// A module is a part of the library in a file of its own, for what it brings along: OpenImageIO
/// alone has some 250 libraries. It is opened when something needs it first. What it gives begins
/// with this and is returned by its one function, `nacre_module`.
struct ModuleHead {
  const char* build;  ///< What library and module were built with: NACRE_BUILD_KEY.
  const char* name;   ///< "nacre_images"
};

/// Why there is no module, for a diagnostic.
struct ModuleFault {
  std::string expected;  ///< The file that was looked for, in all its places.
  std::string found;     ///< What is wrong with it.
};

/// Opens the module of that name or gives what was opened before: null, with the
/// fault, if it is not there, cannot be loaded or is another one, or of another build. It stays
/// open as long as the process lives. Any thread; a fork() waits for who is opening one.
const ModuleHead* open_module(const std::string& name, ModuleFault& fault);

}  // namespace nacre

/// What a module defines.
extern "C" const nacre::ModuleHead* nacre_module();
