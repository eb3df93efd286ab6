#include "examples/tool/bake/inputs.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "examples/common/file_digest.h"
#include "examples/common/materialx_libraries.h"
#include "examples/tool/paths.h"
#include "runtime/texture/tile_set.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

/// Adds the digest of a file that there has to be.
bool add_file(const std::string& name, const fs::path& path, Facts& facts,
              Diagnostics& diagnostics) {
  const auto digest = host::digest_of_file(path.string());
  if (!digest) {
    diagnostics.error("cannot-read", {path.string(), 0, 0, {}}, "the file cannot be read again");
    return false;
  }
  facts[name] = to_hex(*digest);
  return true;
}

/// A file, or all that are below a folder.
bool add_library(const fs::path& library, Facts& facts, Diagnostics& diagnostics) {
  std::error_code status;
  if (!fs::is_directory(library, status)) {
    return add_file(library.filename().string(), library, facts, diagnostics);
  }
  for (const auto& entry : fs::recursive_directory_iterator(library, status)) {
    if (!entry.is_regular_file(status)) continue;
    const fs::path name = library.filename() / entry.path().lexically_relative(library);
    if (!add_file(name.generic_string(), entry.path(), facts, diagnostics)) return false;
  }
  return true;
}

/// One digest of all files of the data library, whose names are those of a release of MaterialX.
std::string data_library(const Document& library) {
  const std::string folder = find_materialx_libraries().string();
  Sha256 all;
  for (const std::string& file : library.files()) {
    if (!file.starts_with(folder)) continue;
    if (const auto digest = host::digest_of_file(file)) all.add(to_hex(*digest));
  }
  return to_hex(all.finish());
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ":") + text;
  return all;
}

const char* name_of(Preference preference) {
  switch (preference) {
    case Preference::body: return "body";
    case Preference::graph: return "graph";
    case Preference::source: break;
  }
  return "source";
}

Facts facts_of(const CommonOptions& options) {
  Facts facts;
  facts["accuracy"] = options.accuracy;
  facts["anisotropy"] = fmt::format("{}", options.anisotropy);
  // The interpreter gives the same bits.
  facts["backend"] = options.backend == "reference" ? "reference" : "jit";
  // Only then do results depend on it.
  if (options.accuracy == "fast") {
    facts["lanes"] = fmt::format("{}", options.lanes);
    for (const Fact& fact : options.facts) facts["facts"] += to_string(fact) + "; ";
  }
  if (options.fade_noise) facts["fade-noise"] = "yes";
  facts["missing-images"] =
      options.missing_images == MissingImages::error ? "error" : "use_default";
  facts["prefer"] = name_of(options.graph_limits.prefer);
  facts["search-path"] = joined(options.search_paths);
  facts["strict"] = options.strict ? "yes" : "no";
  // What there is no room for is read by tiles, of which coarse levels are others.
  facts["texture-memory"] = fmt::format("{}", options.texture_limits.budget);
  facts["working-space"] = options.working_space.value_or("default");
  return facts;
}

std::string quoted(const std::string& text) { return text.empty() ? "nothing" : text; }

}  // namespace

std::string InputDigests::of(const std::string& path, FileIdentity* identity) {
  if (has_tile_token(path)) {
    Diagnostics ignored;
    Sha256 all;
    const auto tiles = find_tiles(path, {}, ignored);
    if (!tiles) return {};
    for (const TileFile& tile : *tiles) all.add(fmt::format("{} {}\n", tile.u, tile.v));
    return to_hex(all.finish());
  }
  const FileIdentity now = identify(path);
  if (identity != nullptr) *identity = now;
  const auto known = known_.find(path);
  if (known != known_.end() && known->second.first == now) return known->second.second;
  FileIdentity read;
  const auto digest = host::digest_of_file(path, &read);
  if (identity != nullptr && digest) *identity = read;
  return known_[path] = {digest ? read : now, digest ? to_hex(*digest) : ""}, known_[path].second;
}

std::string document_digest(const Document& document) {
  Sha256 all;
  for (const std::string& file : document.files()) {
    const auto digest = host::digest_of_file(file);
    if (!digest) return {};
    all.add(to_hex(*digest));
  }
  return to_hex(all.finish());
}

bool describe_inputs(const CommonOptions& options, const Opened& opened, BakeManifest& manifest,
                     Diagnostics& diagnostics) {
  manifest.version = NACRE_TOOL_VERSION;
  manifest.options = facts_of(options);
  const fs::path folder = fs::path(options.file).parent_path();
  for (const std::string& file : opened.document->files()) {
    if (!add_file(from_folder(file, folder), file, manifest.inputs, diagnostics)) return false;
  }
  manifest.inputs["data library"] = data_library(opened.system->library().document());
  for (const std::string& library : options.libraries) {
    if (!add_library(library, manifest.inputs, diagnostics)) return false;
  }
  const char* const environment = std::getenv("OCIO");
  const bool is_named = options.ocio == "env";
  const std::string config = is_named && environment != nullptr ? environment : options.ocio;
  if (!config.empty() && !add_file("configuration", config, manifest.inputs, diagnostics)) {
    return false;
  }
  return options.profile.empty() ||
         add_file("profile", options.profile, manifest.inputs, diagnostics);
}

std::string difference(const Facts& there, const Facts& wanted) {
  std::set<std::string> names;
  for (const auto& [name, value] : there) names.insert(name);
  for (const auto& [name, value] : wanted) names.insert(name);
  const auto value_of = [](const Facts& facts, const std::string& name) {
    const auto found = facts.find(name);
    return found != facts.end() ? found->second : std::string();
  };
  for (const std::string& name : names) {
    const std::string was = value_of(there, name);
    const std::string is = value_of(wanted, name);
    if (was != is) return fmt::format("{} was {}, not {}", name, quoted(was), quoted(is));
  }
  return {};
}

std::string difference(const BakeManifest& there, const BakeManifest& wanted) {
  if (there.version != wanted.version) {
    return fmt::format("it is of Nacre {}, not {}", quoted(there.version), wanted.version);
  }
  for (const auto& [name, digest] : wanted.inputs) {
    const auto found = there.inputs.find(name);
    if (found == there.inputs.end()) return fmt::format("{} is new", name);
    if (found->second != digest) return fmt::format("{} has changed", name);
  }
  for (const auto& [name, digest] : there.inputs) {
    if (!wanted.inputs.contains(name)) return fmt::format("{} is no longer read", name);
  }
  return difference(there.options, wanted.options);
}

}  // namespace nacre::tool
