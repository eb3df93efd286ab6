#include "jit/tune/json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "jit/tune/dimension.h"

namespace nacre {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no numbers that are not finite.
Json number(double value) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  return value;
}

}  // namespace

Json as_json(const Error& error) {
  return {{"mean", number(error.mean)},
          {"p999", number(error.p999)},
          {"maximum", number(error.maximum)}};
}

Json as_json(const Choices& choices) {
  Json json = Json::object();
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Dimension& dimension = dimensions()[i];
    json[std::string(dimension.name)] = dimension.settings[choices[i]];
  }
  return json;
}

}  // namespace nacre
