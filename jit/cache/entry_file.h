#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "jit/llvm/codegen.h"

namespace nacre {

/// 128 bits over bytes, as 32 hexadecimal digits. Any damage to one word changes it.
std::string digest(std::string_view bytes);

/// A kernel as the bytes of a file: a head with all sizes and a digest of the
/// rest, then the whole key, the symbol and the object.
std::string pack(std::string_view key, const ObjectCode& object);

/// The object, if the bytes are a sound file of exactly this key.
std::optional<ObjectCode> unpack(std::string_view file, std::string_view key);

}  // namespace nacre
