#pragma once

#include <string_view>

#include "runtime/program/recorder.h"

namespace nacre {

/// What is recorded while it lives is for `name`.
class ScopedOrigin {
 public:
  ScopedOrigin(Recorder& recorder, std::string_view name)
      : recorder_(recorder), before_(recorder.begin_origin(name)) {}
  /// For what Recorder::origin() was at some time.
  ScopedOrigin(Recorder& recorder, std::uint32_t origin)
      : recorder_(recorder), before_(recorder.origin()) {
    recorder.set_origin(origin);
  }
  ~ScopedOrigin() { recorder_.set_origin(before_); }
  ScopedOrigin(const ScopedOrigin&) = delete;
  ScopedOrigin& operator=(const ScopedOrigin&) = delete;

 private:
  Recorder& recorder_;
  std::uint32_t before_;
};

}  // namespace nacre
