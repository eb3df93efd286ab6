#pragma once

#include <optional>
#include <string>

#include "examples/tool/bake/shard.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// What the command line says about the record of a bake, and about sharing it among runs.
struct ManifestRequest {
  std::string file;              ///< --manifest, "" if not given.
  std::string shard_text;        ///< --shard, "" if not given.
  std::size_t merge = 0;         ///< --merge: so many shards; 0 if not given.
  std::optional<Shard> shard{};  ///< Once check() has read it.

  void add(CLI::App& command);
  /// Reads --shard; false with an error if it cannot be understood.
  bool check(Diagnostics& diagnostics);

  /// Whether anything is recorded.
  bool is_asked() const { return !file.empty() || shard || merge > 0; }
  /// The manifest of the whole: what was asked for, or nacre-bake.json in `folder`.
  std::string whole(const std::string& folder) const;
  /// That of a shard, beside it: nacre-bake.3-of-8.json.
  std::string part(const std::string& folder, const Shard& of) const;
};

}  // namespace nacre::tool
