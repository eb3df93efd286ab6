#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nacre::host {

// Mattes by name: Friedman and Jones, "Cryptomatte Specification", version 1.2.0 (Psyop, 2015 to
// 2018).

/// MurmurHash3, x86, 32 bits, seed 0 (Appleby), which the specification names by.
std::uint32_t matte_hash(std::string_view name);

/// The float that stands for a hash in an image: its bits, but for numbers that are none, or
/// denormal (section "Hash to float conversion").
float matte_id(std::uint32_t hash);

/// Which names a pixel shows, and how much of each.
class MattePixel {
 public:
  /// Another sample of it. Those that hit nothing are not added.
  void add(std::uint32_t name);
  /// How many samples show a name.
  struct Count {
    std::uint32_t name, samples;
  };
  /// At most so many, those with the most samples first; of equal ones the lower number.
  std::vector<Count> ranked(std::size_t most) const;

  std::vector<Count> counts;
};

/// Images that a set of mattes is in.
struct Mattes {
  static constexpr int ranks = 6;  ///< Of names in a pixel that are kept; a layer holds two.

  Mattes(std::string type, const std::vector<std::string>& of_meshes, std::size_t pixels);

  std::string type;                        ///< "CryptoObject"
  std::vector<std::string> names;          ///< Each once,
  std::vector<float> ids;                  ///< and their matte_id.
  std::vector<std::uint32_t> of_mesh;      ///< Indices of them.
  std::vector<std::vector<float>> planes;  ///< Id and share of each rank, one after another.

  /// Channels of an image for the planes: "CryptoObject00.R", …
  std::vector<std::string> channels() const;
  /// What the specification wants in the image's header, names of attributes with texts.
  std::vector<std::pair<std::string, std::string>> attributes() const;
};

}  // namespace nacre::host
