#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace nacre {

/// Words moved in one turn of the loops below: enough that the loop itself counts for little.
inline constexpr std::size_t words_together = 8;

/// to[i] = the word at `address(i)`, which need not be aligned.
template <class Address>
void gather_words(std::size_t count, std::uint32_t* to, Address&& address) {
  std::size_t i = 0;
  for (; i + words_together <= count; i += words_together) {
    std::array<std::uint32_t, words_together> words;
    for (std::size_t k = 0; k < words.size(); ++k) std::memcpy(&words[k], address(i + k), 4);
    std::memcpy(to + i, words.data(), sizeof words);
  }
  for (; i < count; ++i) std::memcpy(to + i, address(i), 4);
}

/// The word at `address(i)` = from[i], in ascending order of i.
template <class Address>
void scatter_words(std::size_t count, const std::uint32_t* from, Address&& address) {
  std::size_t i = 0;
  for (; i + words_together <= count; i += words_together) {
    std::array<std::uint32_t, words_together> words;
    std::memcpy(words.data(), from + i, sizeof words);
    for (std::size_t k = 0; k < words.size(); ++k) std::memcpy(address(i + k), &words[k], 4);
  }
  for (; i < count; ++i) std::memcpy(address(i), from + i, 4);
}

}  // namespace nacre
