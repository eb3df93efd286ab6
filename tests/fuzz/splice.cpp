#include "tests/fuzz/splice.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/fuzz/changes.h"
#include "tests/fuzz/generate.h"

namespace nacre::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_source_bytes = 24'000;  // Larger ones take long and add little.
constexpr std::size_t most_elements = 1500;
constexpr std::size_t most_values = 4000;  // Of one attribute.

std::vector<fs::path> documents_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".mtlx") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Source> read_all(const std::vector<fs::path>& folders, std::size_t most_bytes) {
  std::vector<Source> sources;
  for (const fs::path& folder : folders) {
    for (const fs::path& file : documents_below(folder)) {
      std::ifstream stream(file, std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      auto tree = text.size() <= most_bytes ? read_tree(text) : std::nullopt;
      if (tree) sources.push_back({file, std::move(*tree)});
    }
  }
  return sources;
}

void append_parts(const std::vector<Source>& sources, std::vector<const Tree*>& parts) {
  for (const Source& source : sources) {
    const auto elements = all_elements(source.tree);
    parts.insert(parts.end(), elements.begin(), elements.end());
  }
}

}  // namespace

std::vector<Source> read_sources(const std::vector<fs::path>& folders) {
  return read_all(folders, most_source_bytes);
}

Splicer::Splicer(std::vector<Source> sources, std::vector<Source> library)
    : sources_(std::move(sources)), library_(std::move(library)) {
  append_parts(sources_, source_parts_);
  append_parts(library_, library_parts_);
  std::map<std::string, std::set<std::string>> values;
  std::set<std::string> categories;
  for (const auto* parts : {&source_parts_, &library_parts_}) {
    for (const Tree* part : *parts) {
      categories.insert(part->category);
      for (const auto& [name, value] : part->attributes) {
        auto& known = values[name];
        if (known.size() < most_values) known.insert(value);
      }
    }
  }
  for (const Tree* part : library_parts_) {
    if (part->category == "nodedef") nodedefs_.push_back(part);
  }
  categories_.assign(categories.begin(), categories.end());
  for (const auto& [name, known] : values) {
    attribute_names_.push_back(name);
    values_[name].assign(known.begin(), known.end());
  }
}

const std::vector<std::string>& Splicer::values(const std::string& attribute) const {
  static const std::vector<std::string> none{""};
  const auto found = values_.find(attribute);
  return found == values_.end() ? none : found->second;
}

const Tree& Splicer::part(Random& random, const Tree* donor) const {
  if (donor != nullptr) {
    const auto parts = all_elements(*donor);
    return *random.pick(parts);
  }
  const bool from_library = !library_parts_.empty() && random.one_in(4);
  return *random.pick(from_library ? library_parts_ : source_parts_);
}

const Tree& Splicer::part_like(const std::string& category, Random& random,
                               const Tree* donor) const {
  const Tree* found = &part(random, donor);
  for (int tries = 0; tries < 40 && found->category != category; ++tries) {
    found = &part(random, donor);
  }
  return *found;
}

void Splicer::mutate(Tree& tree, Random& random, int changes, const Tree* donor) const {
  for (int i = 0; i < changes; ++i) {
    Change{*this, tree, donor, random}.apply();
    if (all_elements(tree).size() > most_elements) return;
  }
}

Mutant Splicer::mutant(std::uint64_t seed) const {
  Random random(seed * 0x2545f4914f6cdd1d + 1);
  Source source = random.pick(sources_);
  if (!nodedefs_.empty() && random.one_in(2)) source = {source.file, generate(nodedefs_, random)};
  // Half of the exchanges are between two documents, so that references between the parts hold.
  const Source& other = random.pick(sources_);
  int changes = 1;
  while (changes < 12 && random.one_in(2)) ++changes;
  mutate(source.tree, random, changes, random.one_in(2) ? &other.tree : nullptr);
  return {source.file.parent_path() / "mutant.mtlx", write_tree(source.tree)};
}

const Splicer& project_splicer() {
  static const Splicer splicer = [] {
    const fs::path root = NACRE_SOURCE_DIR;
    const char* library = std::getenv("NACRE_MATERIALX_LIBRARIES");
    const char* more = std::getenv("NACRE_FUZZ_DOCUMENTS");
    std::vector<Source> sources =
        read_sources({root / "examples", root / "bench" / "documents", root / "tests" / "documents",
                      root / "tests" / "fuzz" / "documents", more != nullptr ? more : ""});
    // Documents that are right but few count as much as the many that are wrong already.
    const std::vector<Source> right = read_sources(
        {root / "examples", root / "bench" / "documents", root / "tests" / "fuzz" / "documents"});
    for (int i = 0; i < 12; ++i) sources.insert(sources.end(), right.begin(), right.end());
    return Splicer(
        std::move(sources),
        read_all({library != nullptr ? library : NACRE_MATERIALX_LIBRARIES_DIR}, std::size_t(-1)));
  }();
  return splicer;
}

}  // namespace nacre::fuzz
