#pragma once

#include <nlohmann/json_fwd.hpp>

#include "jit/tune/choices.h"
#include "jit/tune/error.h"

namespace nacre {

/// {"mean": ..., "p999": ..., "maximum": ...}; a number that is not finite is a text, "inf".
nlohmann::ordered_json as_json(const Error& error);

/// A setting for each dimension: {"accuracy": "fast", ...}.
nlohmann::ordered_json as_json(const Choices& choices);

}  // namespace nacre
