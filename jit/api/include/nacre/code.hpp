/// \file
/// The machine code of shaders, called without a Binding: beside <nacre/nacre.hpp>.
#ifndef NACRE_CODE_HPP
#define NACRE_CODE_HPP

#include <nacre/code.h>

#include <cstdint>
#include <nacre/shader.hpp>

namespace nacre {
inline namespace v0 {

/// The floating-point environment that code runs in, for the calling thread; see nacre_enter.
class FloatEnvironment {
 public:
  FloatEnvironment() : own_(nacre_enter()) {}
  ~FloatEnvironment() { nacre_leave(own_); }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  std::uint32_t own_;
};

/// An entry of a shader, with values of its parameters and images as they are now.
class Code {
 public:
  /// Throws Error where there is no machine code. `single`: for one point at a time, see
  /// CompileOptions::single_points.
  Code(const Shader& shader, nacre_entry entry, const Instance* instance = nullptr,
       bool single = false) {
    const detail::Said report;
    nacre_code* made = nullptr;
    report.finish(
        nacre_code_create(shader.get(), entry, instance != nullptr ? instance->get() : nullptr,
                          single, report.get(), &made),
        nullptr);
    code_.reset(made);
    function_ = nacre_code_function(made);
  }

  /// Points of one pass.
  int lanes() const { return nacre_code_lanes(get()); }
  /// See nacre_function. Within a FloatEnvironment.
  nacre_status operator()(const void* const* inputs, void* const* outputs,
                          std::uint64_t count) const {
    return function_(get(), inputs, outputs, count);
  }
  nacre_function function() const { return function_; }
  nacre_code* get() const { return code_.get(); }

 private:
  detail::Owned<nacre_code, nacre_code_destroy> code_;
  nacre_function function_ = nullptr;
};

}  // namespace v0
}  // namespace nacre

#endif
