#pragma once

#include <CLI/CLI.hpp>

namespace nacre::tool {

/// For an option that is a number of at least `low` and at most `high`, infinities and NaN
/// excluded; what it says has few digits.
CLI::Validator number_within(double low, double high = 1e18);

/// For an option that is a number of bytes, "64MB" among them: of those that are none says so.
CLI::Validator as_size();

}  // namespace nacre::tool
