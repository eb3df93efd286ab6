#pragma once

#include <cstdint>

namespace nacre {

/// The floating-point environment that every Program runs in, whatever the
/// host's is: round to nearest even, denormals flushed to zero on the way in
/// and out, exceptions masked. Set on construction, the host's restored on
/// destruction, sticky flags included.
class ScopedFloatEnvironment {
 public:
  ScopedFloatEnvironment();
  ~ScopedFloatEnvironment();
  ScopedFloatEnvironment(const ScopedFloatEnvironment&) = delete;
  ScopedFloatEnvironment& operator=(const ScopedFloatEnvironment&) = delete;

 private:
  std::uint32_t saved_;
};

}  // namespace nacre
