#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/tree.h"

namespace nacre::fuzz {

/// Decisions from a seed, the same on every machine (SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// 0 ... count - 1; 0 for a count of 0.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : next() % count; }
  bool one_in(std::size_t count) { return below(count) == 0; }
  template <class List>
  auto& pick(List& list) {
    return list[below(list.size())];
  }

 private:
  std::uint64_t state_;
};

/// A document as it was found; `file` is where its includes and images are looked for.
struct Source {
  std::filesystem::path file;
  Tree tree;
};

/// The documents below folders that are small enough to be varied, ordered by path.
std::vector<Source> read_sources(const std::vector<std::filesystem::path>& folders);

struct Mutant {
  std::filesystem::path file;  ///< Beside the document that it began as; nothing is written there.
  std::string text;
};

/// Makes wrong documents of right ones by exchanging elements, attributes, values, names
/// and references between them, and between them and the data library. What comes out is
/// XML; most of it still means something, which is what random bytes never do.
class Splicer {
 public:
  /// `library` gives parts only, its nodedefs above all.
  Splicer(std::vector<Source> sources, std::vector<Source> library);

  /// Document number `seed`: always the same for the same sources.
  Mutant mutant(std::uint64_t seed) const;

  /// Changes a document in place, with parts of `donor` where one is given.
  void mutate(Tree& tree, Random& random, int changes, const Tree* donor = nullptr) const;

  const std::vector<Source>& sources() const { return sources_; }

  /// Values that attributes of a name have anywhere, each once.
  const std::vector<std::string>& values(const std::string& attribute) const;
  const std::vector<std::string>& categories() const { return categories_; }
  const std::vector<std::string>& attribute_names() const { return attribute_names_; }
  /// An element of a document or of the library, at random.
  const Tree& part(Random& random, const Tree* donor) const;
  /// The same, of a category if one is soon found.
  const Tree& part_like(const std::string& category, Random& random, const Tree* donor) const;
  const std::vector<const Tree*>& library_nodedefs() const { return nodedefs_; }

 private:
  std::vector<Source> sources_;
  std::vector<Source> library_;
  std::vector<const Tree*> source_parts_;
  std::vector<const Tree*> library_parts_;
  std::vector<const Tree*> nodedefs_;
  std::map<std::string, std::vector<std::string>> values_;
  std::vector<std::string> categories_;
  std::vector<std::string> attribute_names_;
};

/// A splicer of the project's own documents and the data library, made once a process; and of
/// those below the folder that NACRE_FUZZ_DOCUMENTS names, if it does.
const Splicer& project_splicer();

}  // namespace nacre::fuzz
