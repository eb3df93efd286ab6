#pragma once

#include <map>
#include <string>
#include <utility>

#include "examples/tool/bake/manifest.h"
#include "examples/tool/options.h"
#include "runtime/texture/file_identity.h"

namespace nacre::tool {

/// Digests of files that a bake reads, each computed once as long as it stays the same file.
class InputDigests {
 public:
  /// In hexadecimal, "" where there is no such file. Of a name with <UDIM> or <UVTILE> that of
  /// the list of files it stands for. `identity`: of the file, unless null.
  std::string of(const std::string& path, FileIdentity* identity = nullptr);

 private:
  std::map<std::string, std::pair<FileIdentity, std::string>> known_;
};

/// What all files of a bake depend on: version, inputs and options of a manifest. False, with an
/// error, where a file that was read cannot be read again.
bool describe_inputs(const CommonOptions& options, const Opened& opened, BakeManifest& manifest,
                     Diagnostics& diagnostics);

/// Of the digests of a document's files, the main one first; "" where they cannot be read again.
std::string document_digest(const Document& document);

/// What differs in a manifest from what is wanted, "" for nothing: "the option accuracy was fast,
/// not standard".
std::string difference(const BakeManifest& there, const BakeManifest& wanted);
/// The same of the settings of a file.
std::string difference(const Facts& there, const Facts& wanted);

}  // namespace nacre::tool
