#include "runtime/near_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace nacre {

namespace {

/// Longer names than people write by hand have nothing near.
constexpr std::size_t longest = 100;

char fold_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// How many slips lead from one name to the other; more than `most` where that is more.
std::size_t count_slips(std::string_view a, std::string_view b, std::size_t most) {
  const std::size_t longer = std::max(a.size(), b.size());
  if (longer - std::min(a.size(), b.size()) > most) return most + 1;
  const auto same = [&](std::size_t i, std::size_t j) {
    return fold_case(a[i - 1]) == fold_case(b[j - 1]);
  };
  // Rows of the table of slips between beginnings of both, i letters of a and j of b.
  using Row = std::array<std::size_t, longest + 1>;
  Row first, second, third;
  Row *before = &first, *last = &second, *row = &third;
  for (std::size_t j = 0; j <= b.size(); ++j) (*row)[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    std::size_t least = (*row)[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t& slips = (*row)[j];
      slips = std::min({(*last)[j] + 1, (*row)[j - 1] + 1, (*last)[j - 1] + (same(i, j) ? 0 : 1)});
      const bool is_swapped = i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j);
      if (is_swapped) slips = std::min(slips, (*before)[j - 2] + 1);
      least = std::min(least, slips);
    }
    // A swap jumps over a row, from what is at most one less than the least of it.
    if (least > most + 1) return most + 1;
  }
  return (*row)[b.size()];
}

}  // namespace

NearNames::NearNames(std::string_view wanted)
    : wanted_(wanted.substr(0, longest + 1)),
      most_slips_(std::min<std::size_t>(wanted_.size() / 3, 3)) {}

void NearNames::offer(std::string_view known) {
  if (wanted_.empty() || wanted_.size() > longest || offered_ == most_offered) return;
  ++offered_;
  if (known.empty() || known.size() > longest || known == wanted_) return;
  const std::size_t slips = count_slips(wanted_, known, most_slips_);
  if (slips > most_slips_) return;
  Near found{slips, std::string(known)};
  const auto place = std::ranges::lower_bound(near_, found);
  if (place != near_.end() && *place == found) return;
  near_.insert(place, std::move(found));
  if (near_.size() > most_given) near_.pop_back();
}

std::vector<std::string> NearNames::names() const {
  std::vector<std::string> names;
  for (const Near& each : near_) {
    if (each.slips == near_.front().slips) names.push_back(each.name);
  }
  return names;
}

std::string NearNames::hint(std::string_view before) const {
  const std::vector<std::string> near = names();
  if (near.empty()) return {};
  std::string list;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (i > 0) list += i + 1 < near.size() ? ", " : " or ";
    list += fmt::format("'{}{}'", before, near[i]);
  }
  if (near_.front().slips == 0) return "it differs only in case from " + list;
  return fmt::format("did you mean {}?", list);
}

}  // namespace nacre
