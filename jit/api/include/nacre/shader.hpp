/// \file
/// Compiled kernels and the values of their parameters: part of <nacre/nacre.hpp>.
#ifndef NACRE_SHADER_HPP
#define NACRE_SHADER_HPP

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <nacre/diagnostic.hpp>
#include <string>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {

/// What may change without compiling; see nacre_parameter.
struct Parameter {
  std::string name;
  std::string type;
  int number_type = NACRE_FLOAT;
  int components = 1;
  bool is_varying = false;
  std::vector<float> value;             ///< The document's; integers and booleans as numbers.
  std::vector<float> minimum, maximum;  ///< Empty: no limit.
  std::string label, folder, unit, document;
};

/// A channel of a kernel; see nacre_channel.
struct Channel {
  std::string name;
  int component = -1;
  int type = NACRE_FLOAT;
  int role = NACRE_POINT;
  std::string unit, meaning;
};

/// A lobe of a material; see nacre_lobe_info.
struct LobeInfo {
  std::string name, path;
  int kinds = 0;
};

/// The compiled kernels of a material or of outputs.
class Shader {
 public:
  /// Takes a handle of the C interface, which is destroyed with it.
  static Shader adopt(nacre_shader* shader) { return Shader(shader); }

  bool has(nacre_entry entry) const { return nacre_shader_has(get(), entry) != 0; }
  std::vector<Channel> inputs(nacre_entry entry) const {
    return channels(entry, nacre_shader_input_count, nacre_shader_input);
  }
  std::vector<Channel> results(nacre_entry entry) const {
    return channels(entry, nacre_shader_result_count, nacre_shader_result);
  }
  /// Numbers a point that NACRE_BEGIN stores for the other entries.
  std::size_t state_count() const { return nacre_shader_state_count(get()); }
  bool has_back() const { return nacre_shader_has_back(get()) != 0; }
  std::vector<LobeInfo> lobes() const {
    std::vector<LobeInfo> list;
    for (std::size_t i = 0; i < nacre_shader_lobe_count(get()); ++i) {
      nacre_lobe_info one{};
      one.size = sizeof one;
      detail::check(nacre_shader_lobe(get(), i, &one));
      list.push_back({one.name, one.path, one.kinds});
    }
    return list;
  }
  /// What the kernels leave out, a line each.
  std::vector<std::string> left_out() const {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < nacre_shader_left_out_count(get()); ++i) {
      lines.emplace_back(nacre_shader_left_out(get(), i, nullptr));
    }
    return lines;
  }
  bool is_pending() const { return nacre_shader_is_pending(get()) != 0; }
  /// What is pending stays interpreted.
  void cancel() const { nacre_shader_cancel(get()); }
  /// Calls once when nothing is pending: at once, or by a thread that compiles. Does not throw.
  void when_ready(std::function<void()> call) const {
    auto kept = std::make_unique<std::function<void()>>(std::move(call));
    detail::check(nacre_shader_when_ready(
        get(),
        [](void* user) {
          const std::unique_ptr<std::function<void()>> mine(
              static_cast<std::function<void()>*>(user));
          (*mine)();
        },
        kept.get()));
    static_cast<void>(kept.release());
  }
  /// Throws Error where an entry stays interpreted.
  void wait() const {
    const detail::Said report;
    report.finish(nacre_shader_wait(get(), report.get()), nullptr);
  }

  std::vector<Parameter> parameters() const {
    std::vector<Parameter> list;
    for (std::size_t i = 0; i < nacre_shader_parameter_count(get()); ++i) {
      nacre_parameter one{};
      one.size = sizeof one;
      detail::check(nacre_shader_parameter(get(), i, &one));
      const auto numbers = [&](const void* from) {
        std::vector<float> values;
        for (int k = 0; from != nullptr && k < one.components; ++k) {
          values.push_back(one.number_type == NACRE_FLOAT
                               ? static_cast<const float*>(from)[k]
                               : static_cast<float>(static_cast<const std::int32_t*>(from)[k]));
        }
        return values;
      };
      list.push_back({one.name, one.type, one.number_type, one.components, one.is_varying != 0,
                      numbers(one.value), numbers(one.minimum), numbers(one.maximum), one.label,
                      one.folder, one.unit, one.document});
    }
    return list;
  }
  nacre_shader* get() const { return shader_.get(); }

 private:
  friend class System;
  explicit Shader(nacre_shader* shader) : shader_(shader) {}

  template <class Count, class Get>
  std::vector<Channel> channels(nacre_entry entry, Count&& count, Get&& channel) const {
    std::vector<Channel> list;
    for (std::size_t i = 0; i < count(get(), entry); ++i) {
      nacre_channel one{};
      one.size = sizeof one;
      detail::check(channel(get(), entry, i, &one));
      list.push_back({one.name, one.component, one.type, one.role, one.unit, one.meaning});
    }
    return list;
  }

  detail::Owned<nacre_shader, nacre_shader_destroy> shader_;
};

/// Values of a shader's parameters.
class Instance {
 public:
  explicit Instance(const Shader& shader) : shader_(shader.get()) {
    nacre_instance* made = nullptr;
    detail::check(nacre_instance_create(shader.get(), &made));
    instance_.reset(made);
  }
  /// As many numbers of the parameter's number_type as it has components. The shader must live.
  /// @{
  void set(const std::string& parameter, std::initializer_list<float> values) {
    set_numbers(parameter, values.begin(), values.size(), NACRE_FLOAT);
  }
  void set(const std::string& parameter, float value) {
    set_numbers(parameter, &value, 1, NACRE_FLOAT);
  }
  void set(const std::string& parameter, std::int32_t value) {
    set_numbers(parameter, &value, 1, NACRE_INT);
  }
  void set(const std::string& parameter, bool value) {
    const std::int32_t bits = value;
    set_numbers(parameter, &bits, 1, NACRE_BOOL);
  }
  /// @}
  nacre_instance* get() const { return instance_.get(); }

 private:
  void set_numbers(const std::string& name, const void* values, std::size_t count, int type) {
    const std::size_t index = nacre_shader_find_parameter(shader_, name.c_str());
    nacre_parameter parameter{};
    parameter.size = sizeof parameter;
    const bool is_known =
        index != SIZE_MAX && nacre_shader_parameter(shader_, index, &parameter) == NACRE_OK;
    const bool fits = is_known && parameter.number_type == type &&
                      static_cast<std::size_t>(parameter.components) == count;
    if (!fits) {
      const std::string found = is_known ? std::string("a ") + parameter.type : "none of that name";
      Diagnostic said;
      said.code = "bad-parameter";
      said.path = name;
      said.text = said.message = "'" + name + "' cannot be set to that: the shader has " + found;
      throw Error(NACRE_WRONG_ARGUMENTS, {said});
    }
    detail::check(nacre_instance_set(get(), index, values));
  }

  const nacre_shader* shader_;
  detail::Owned<nacre_instance, nacre_instance_destroy> instance_;
};

}  // namespace v0
}  // namespace nacre

#endif
