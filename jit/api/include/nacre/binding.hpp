/// \file
/// Where a host has its numbers, and running kernels on them: part of <nacre/nacre.hpp>.
#ifndef NACRE_BINDING_HPP
#define NACRE_BINDING_HPP

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <nacre/shader.hpp>
#include <string>
#include <vector>

namespace nacre {
inline namespace v0 {

/// Where one channel, or a group of them, is in a host's arrays; see nacre_layout.
struct Layout {
  std::uint32_t array = 0;
  std::ptrdiff_t offset = 0;
  std::ptrdiff_t stride = sizeof(float);
  std::ptrdiff_t component_stride = sizeof(float);
  int element = NACRE_OF_POINT;
};

/// What a host has, said once for all shaders.
class Binder {
 public:
  Binder() {
    nacre_binder* made = nullptr;
    detail::check(nacre_binder_create(&made));
    binder_.reset(made);
  }
  Binder& array(const std::string& name, const Layout& layout) {
    nacre_layout asked{};
    asked.size = sizeof asked;
    asked.array = layout.array;
    asked.element = layout.element;
    asked.offset = layout.offset;
    asked.stride = layout.stride;
    asked.component_stride = layout.component_stride;
    detail::check(nacre_binder_array(get(), name.c_str(), &asked));
    return *this;
  }
  /// The same numbers for all points.
  Binder& constant(const std::string& name, std::initializer_list<float> values) {
    detail::check(nacre_binder_constant(get(), name.c_str(), values.begin(), values.size()));
    return *this;
  }
  /// The same of a channel of integers or booleans.
  Binder& integers(const std::string& name, std::initializer_list<std::int32_t> values) {
    detail::check(nacre_binder_constant(get(), name.c_str(), values.begin(), values.size()));
    return *this;
  }
  nacre_binder* get() const { return binder_.get(); }

 private:
  detail::Owned<nacre_binder, nacre_binder_destroy> binder_;
};

/// Points to shade; see nacre_batch.
struct Batch {
  std::uint64_t count = 0;
  const std::uint32_t* points = nullptr;
  const std::uint32_t* instances = nullptr;
  const volatile std::uint32_t* stop = nullptr;
  std::uint32_t point = 0;  ///< Of NACRE_EVALUATE_AT.
};

/// A shader's kernels on a host's arrays.
class Binding {
 public:
  /// Throws Error where a channel that a kernel reads is bound to nothing. `entries`: bits
  /// 1 << nacre_entry; 0: all that the shader has.
  Binding(const Binder& binder, const Shader& shader, std::uint32_t entries = 0) {
    const detail::Said report;
    nacre_binding* made = nullptr;
    report.finish(nacre_binding_create(binder.get(), shader.get(), entries, report.get(), &made),
                  nullptr);
    binding_.reset(made);
  }

  /// False where it was stopped. Throws Error where a loop of the document does not end.
  template <class Arrays>
  bool run(nacre_entry entry, const Arrays& arrays, const Batch& batch,
           const Instance* instance = nullptr) const {
    nacre_batch asked{};
    asked.size = sizeof asked;
    asked.arrays = std::data(arrays);
    asked.array_count = std::size(arrays);
    asked.count = batch.count;
    asked.points = batch.points;
    asked.instances = batch.instances;
    asked.stop = batch.stop;
    asked.point = batch.point;
    const nacre_status status =
        nacre_run(get(), entry, instance != nullptr ? instance->get() : nullptr, &asked);
    if (status == NACRE_STOPPED) return false;
    if (status == NACRE_TOO_MANY_STEPS) {
      Diagnostic said;
      said.code = "too-many-steps";
      said.text = said.message = "a loop of the shader does not end";
      throw Error(status, {said});
    }
    detail::check(status);
    return true;
  }
  nacre_binding* get() const { return binding_.get(); }

 private:
  detail::Owned<nacre_binding, nacre_binding_destroy> binding_;
};

}  // namespace v0
}  // namespace nacre

#endif
