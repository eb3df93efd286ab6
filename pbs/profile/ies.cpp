#include "pbs/profile/ies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>

namespace nacre {

namespace {

/// Of the angles that a file may have on one axis, and of all their pairs.
constexpr int most_angles = 100'000;
constexpr double most_values = 1'000'000;

/// Goes through a file by lines, then by numbers. After a fault it gives zeros.
class IesReader {
 public:
  IesReader(std::string_view text, IesFault& fault) : text_(text), fault_(fault) {}

  bool failed() const { return failed_; }
  void fail(std::string message, std::string expected = {}, std::string found = {}) {
    if (failed_) return;
    failed_ = true;
    fault_ = {line_, std::move(message), std::move(expected), std::move(found)};
  }

  /// False at the end.
  bool next_line(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    if (at_ > 0) ++line_;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    at_ = end + 1;
    return true;
  }
  /// Numbers begin on the next line.
  void begin_numbers() {
    if (at_ > 0) ++line_;
  }

  double number(const char* what) {
    skip_separators();
    if (failed_) return 0.0;
    const std::size_t end =
        std::min(text_.find_first_of(separators, std::min(at_, text_.size())), text_.size());
    const std::string_view word = text_.substr(std::min(at_, end), end - std::min(at_, end));
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool is_number = error == std::errc() && rest == digits.data() + digits.size();
    if (!is_number || !std::isfinite(value)) {
      fail(word.empty() ? "the file ends too early" : "this is no number", what,
           std::string(word.substr(0, 40)));
      return 0.0;
    }
    at_ = end;
    return value;
  }

  double number_within(const char* what, double least, double most) {
    const double value = number(what);
    if (failed_ || (value >= least && value <= most)) return value;
    fail("the number is out of its range", fmt::format("{}, {} to {}", what, least, most),
         fmt::format("{}", value));
    return least;
  }

  int whole_number(const char* what, int least, int most) {
    const double value = number_within(what, least, most);
    if (!failed_ && value != std::floor(value)) {
      fail("the number is not whole", what, fmt::format("{}", value));
    }
    return failed_ ? least : static_cast<int>(value);
  }

  std::vector<float> angles(const char* what, int count) {
    std::vector<float> all;
    for (int i = 0; i < count && !failed_; ++i) {
      const auto angle = static_cast<float>(number_within(what, -180.0, 360.0));
      if (!all.empty() && angle < all.back() + LightProfile::shortest_step) {
        fail("angles do not grow",
             fmt::format("at least {}", all.back() + LightProfile::shortest_step),
             fmt::format("{}", angle));
      }
      all.push_back(angle);
    }
    return all;
  }

 private:
  static constexpr std::string_view separators = " \t\r\n,\f\v";

  void skip_separators() {
    for (; at_ < text_.size() && separators.find(text_[at_]) != separators.npos; ++at_) {
      if (text_[at_] == '\n') ++line_;
    }
  }

  std::string_view text_;
  IesFault& fault_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool failed_ = false;
};

/// As far as TILT=, whose value it gives.
std::string_view skip_keywords(IesReader& reader) {
  std::string_view line;
  while (reader.next_line(line)) {
    if (line.starts_with("TILT=")) return line.substr(5);
  }
  reader.fail("this is no light profile", "a line TILT=NONE, TILT=INCLUDE or TILT=<file>");
  return {};
}

/// Lamp geometry, and a factor for each angle of tilt.
void skip_tilt(IesReader& reader) {
  reader.whole_number("the lamp's place in the luminaire", 1, 3);
  const int count = reader.whole_number("the number of tilt angles", 0, most_angles);
  for (int i = 0; i < 2 * count && !reader.failed(); ++i)
    reader.number("an angle or factor of tilt");
}

/// The ranges of LM-63-2002, section 5.13 and 5.14.
struct Range {
  float first, last;
};
bool is_one_of(const std::vector<float>& angles, std::initializer_list<Range> ranges) {
  return std::ranges::any_of(ranges, [&](const Range& range) {
    return angles.front() == range.first && angles.back() == range.last;
  });
}

void check_ranges(IesReader& reader, const LightProfile& profile) {
  const auto found = [](const std::vector<float>& angles) {
    return fmt::format("{} to {}", angles.front(), angles.back());
  };
  if (profile.type == LightProfile::Type::c) {
    if (!is_one_of(profile.vertical, {{0, 90}, {0, 180}, {90, 180}})) {
      reader.fail("vertical angles are not those of type C", "0 to 90, 0 to 180 or 90 to 180",
                  found(profile.vertical));
    }
    if (!is_one_of(profile.horizontal, {{0, 0}, {0, 90}, {0, 180}, {90, 270}, {0, 360}})) {
      reader.fail("horizontal angles are not those of type C",
                  "0; 0 to 90, 0 to 180, 90 to 270 or 0 to 360", found(profile.horizontal));
    }
    return;
  }
  for (const auto* angles : {&profile.vertical, &profile.horizontal}) {
    if (!is_one_of(*angles, {{0, 90}, {-90, 90}})) {
      reader.fail("angles are not those of types A and B", "0 to 90 or -90 to 90", found(*angles));
    }
  }
}

}  // namespace

std::optional<LightProfile> parse_ies(std::string_view text, IesFault& fault) {
  IesReader reader(text, fault);
  const std::string_view tilt = skip_keywords(reader);
  reader.begin_numbers();
  if (tilt == "INCLUDE") skip_tilt(reader);

  reader.number_within("the number of lamps", 0, 1e6);
  reader.number("the lumens of a lamp");  // -1: absolute photometry.
  double scale = reader.number_within("the multiplier of the candela values", 0, 1e12);
  const int vertical = reader.whole_number("the number of vertical angles", 2, most_angles);
  const int horizontal = reader.whole_number("the number of horizontal angles", 1, most_angles);
  LightProfile profile;
  profile.type = LightProfile::Type(reader.whole_number("the photometric type", 1, 3));
  reader.whole_number("the unit of lengths", 1, 2);
  for (const char* what : {"width", "length", "height"}) reader.number(what);
  scale *= reader.number_within("the ballast factor", 0, 1e6);
  reader.number("the ballast-lamp factor, or the file's generation");
  reader.number("the input watts");
  if (double(vertical) * horizontal > most_values) {
    reader.fail("there are too many angles", fmt::format("at most {} pairs", most_values),
                fmt::format("{} times {}", vertical, horizontal));
  }
  profile.vertical = reader.angles("a vertical angle", vertical);
  profile.horizontal = reader.angles("a horizontal angle", horizontal);
  if (!reader.failed()) check_ranges(reader, profile);
  const std::size_t pairs = profile.vertical.size() * profile.horizontal.size();
  for (std::size_t i = 0; i < pairs && !reader.failed(); ++i) {
    const double candela = reader.number_within("a candela value", 0, 1e30);
    profile.intensity.push_back(static_cast<float>(std::min(candela * scale, 1e30)));
  }
  if (reader.failed()) return std::nullopt;
  return profile;
}

}  // namespace nacre
