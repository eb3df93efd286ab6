#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "jit/llvm/codegen.h"

namespace nacre {

/// A kernel as the bytes of a file: a head with all sizes, then the whole key, the symbol,
/// the interface and the object. All of it is signed with a secret (HMAC-SHA-256), so that
/// only who knows the secret can make a file that is taken.
std::string pack(std::string_view key, const ObjectCode& object, std::string_view secret);

/// The object, if the bytes are a file of exactly this key, made with this secret.
std::optional<ObjectCode> unpack(std::string_view file, std::string_view key,
                                 std::string_view secret);

}  // namespace nacre
