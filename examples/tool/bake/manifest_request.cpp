#include "examples/tool/bake/manifest_request.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

namespace nacre::tool {

namespace fs = std::filesystem;

void ManifestRequest::add(CLI::App& command) {
  command
      .add_option("--manifest", file,
                  "Record here what was baked, from what and how; what the file records already, "
                  "and is there and as it would be, is not baked again (default: with --shard and "
                  "--merge nacre-bake.json in the folder of the images, else none)")
      ->type_name("FILE.json");
  CLI::Option* one =
      command
          .add_option("--shard", shard_text,
                      "Bake every N-th image alone, from the I-th on, 1 to N: N such runs share "
                      "the work. Each has a record beside the manifest, FILE.I-of-N.json; a "
                      "--document is written by --merge")
          ->type_name("I/N");
  command
      .add_option("--merge", merge,
                  "Bake nothing: check that the images of all N shards are there and are what "
                  "this command line asks for, and write the --document and the manifest")
      ->check(CLI::Range(std::size_t{1}, most_shards))
      ->type_name("N")
      ->excludes(one);
}

bool ManifestRequest::check(Diagnostics& diagnostics) {
  if (shard_text.empty()) return true;
  shard = parse_shard(shard_text);
  if (shard) return true;
  diagnostics.error("bad-option", {}, "--shard cannot be understood",
                    fmt::format("I/N with I from 1 to N and N up to {}", most_shards), shard_text);
  return false;
}

std::string ManifestRequest::whole(const std::string& folder) const {
  return file.empty() ? (fs::path(folder) / "nacre-bake.json").string() : file;
}

std::string ManifestRequest::part(const std::string& folder, const Shard& of) const {
  fs::path path = whole(folder);
  const std::string extension = path.extension().string();
  return path.replace_extension(fmt::format("{}-of-{}{}", of.index, of.count, extension)).string();
}

}  // namespace nacre::tool
