#pragma once

#include <nacre/nacre.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace nacre::python {

/// What a shader's entries do with the channels of one name, "P.x" or, all of a group, "P".
struct ChannelUse {
  bool is_used = false;    ///< Else it is only known: other shaders have it.
  bool is_stored = false;  ///< Some entry writes it.
  bool is_read = false;
  bool is_scalar = false;  ///< One number a point, by the channel's own name.
  int least = 1;           ///< Components that an array must have.
  int most = 1;            ///< And may have.
  int type = NACRE_FLOAT;
};

/// Over the entries of `entries`, bits 1 << nacre_entry. Nothing where neither the shader nor the
/// table of channels knows the name.
std::optional<ChannelUse> channel_use(const Shader& shader, std::uint32_t entries,
                                      const std::string& name);

/// Whether an array of that name is where the channel's numbers are.
bool covers(std::string_view name, std::string_view channel);

}  // namespace nacre::python
