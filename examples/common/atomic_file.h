#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "runtime/diagnostic.h"

namespace nacre::host {

/// An error that says why a file could not be written. Returns false.
bool write_failed(const std::string& path, const std::string& problem, Diagnostics& diagnostics);

/// Makes a folder where there is none; it must be writable. False with an error.
bool prepare_folder(const std::string& folder, Diagnostics& diagnostics);

/// Makes sure, before the work for it begins, that a file can be written: prepares its
/// folder; what has that name already must be a regular file. False with an error.
bool prepare_output(const std::string& path, Diagnostics& diagnostics);

/// Has `write` fill a partial file (partial_file.h) beside `path`, then gives it that name:
/// a file appears complete or not at all. `write` gets the partial file's name, which keeps
/// the extension, and returns what went wrong, or "". False with an error if anything did;
/// nothing is left then.
bool write_atomically(const std::string& path,
                      const std::function<std::string(const std::string&)>& write,
                      Diagnostics& diagnostics);

/// The same for a text.
bool write_text_atomically(const std::string& path, std::string_view text,
                           Diagnostics& diagnostics);

}  // namespace nacre::host
