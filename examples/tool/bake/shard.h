#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace nacre::tool {

/// One of several runs that share the work: of its pieces, counted from 0, every count-th.
struct Shard {
  std::size_t index = 1;  ///< 1 to count.
  std::size_t count = 1;

  /// The shard that a piece belongs to.
  static std::size_t of(std::size_t piece, std::size_t count) { return piece % count + 1; }
  bool owns(std::size_t piece) const { return of(piece, count) == index; }
  bool operator==(const Shard&) const = default;
};

inline constexpr std::size_t most_shards = 100'000;

/// "3/8"; nothing for what is no such thing.
std::optional<Shard> parse_shard(std::string_view text);

}  // namespace nacre::tool
