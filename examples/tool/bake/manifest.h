#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "examples/bake/texel_statistics.h"
#include "examples/tool/bake/shard.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// Names, and what is known of each: an option's value, or a file's digest.
using Facts = std::map<std::string, std::string>;

/// An image that was baked, or a value that stands for one. Digests are SHA-256, in hexadecimal.
struct BakedRecord {
  std::string file;    ///< From the manifest's folder; "" of a value.
  std::string output;  ///< The graph's output, or NODE.INPUT of a document.
  std::string type;    ///< As MaterialX calls it.
  Facts settings;      ///< All that its bytes depend on beside what the manifest has for all.
  Facts images;        ///< Digests of the files its nodes read, by path from the document's folder;
                       ///< "" where there was none.
  std::string digest;  ///< Of the file.
  std::uint64_t bytes = 0;
  /// False: all texels of a document's map are alike, so that it has a value and no file.
  bool is_kept = true;
  host::TexelStatistics statistics;
  std::vector<float> value;  ///< Of what depends on no point.
  double seconds = 0.0;
};

/// What `nacre bake` records of a bake, or of one shard of it.
struct BakeManifest {
  static constexpr int format = 1;

  std::string version;  ///< Of Nacre.
  std::optional<Shard> shard;
  Facts inputs;   ///< Digests of the documents, definitions, configuration and profile.
  Facts options;  ///< What is the same for all files and matters for their bytes.
  std::vector<BakedRecord> files;
  std::vector<BakedRecord> values;
  std::string document;  ///< The baked document, from the manifest's folder, or "",
  std::string document_digest;
};

/// Nothing where there is no such file; nothing, with an error, for what is no manifest. One of
/// another format has nothing but its version.
std::optional<BakeManifest> read_manifest(const std::string& path, Diagnostics& diagnostics);

/// Whole or not at all.
bool write_manifest(const std::string& path, const BakeManifest& manifest,
                    Diagnostics& diagnostics);

}  // namespace nacre::tool
