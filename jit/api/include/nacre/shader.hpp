/// \file
/// Compiled kernels and the values of their parameters: part of <nacre/nacre.hpp>.
#ifndef NACRE_SHADER_HPP
#define NACRE_SHADER_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <memory>
#include <nacre/diagnostic.hpp>
#include <optional>
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

/// What is known of numbers that kernels read; see nacre_fact.
struct Fact {
  std::string name;
  double minimum = 0, maximum = 0;
};

/// What a fact has left out; see nacre_fact_info.
struct FactInfo {
  Fact fact;
  std::optional<std::uint64_t> saved;
};

/// How far a shader's numbers are off; see nacre_shader_error_info.
struct ShaderError {
  double mean = 0, p999 = 0, maximum = 0;
  std::string worst;
  double floor = 0;
  bool is_absolute = false;
  std::string points;
};

/// Channels of one meaning; see nacre_channel_group.
struct ChannelGroup {
  std::string name;
  int role = NACRE_POINT;
  int components = 1;
  int type = NACRE_FLOAT;
  std::string unit, meaning;
};
/// All that there are.
inline std::vector<ChannelGroup> channel_groups() {
  std::vector<ChannelGroup> list;
  for (std::size_t i = 0; i < nacre_channel_group_count(); ++i) {
    nacre_channel_group one{};
    one.size = sizeof one;
    detail::check(nacre_channel_group_get(i, &one));
    list.push_back({one.name, one.role, one.components, one.type, one.unit, one.meaning});
  }
  return list;
}

namespace detail {

/// As many four-byte numbers as a parameter has components.
inline std::vector<float> numbers_of(const nacre_parameter& parameter, const void* from) {
  std::vector<float> values(static_cast<std::size_t>(parameter.components));
  if (parameter.number_type == NACRE_FLOAT) {
    std::memcpy(values.data(), from, sizeof(float) * values.size());
    return values;
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::int32_t number = 0;
    std::memcpy(&number, static_cast<const char*>(from) + sizeof number * k, sizeof number);
    values[k] = static_cast<float>(number);
  }
  return values;
}

}  // namespace detail

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
  /// What the kernels leave out, a line each; all, or what changes the picture alone.
  std::vector<std::string> left_out(bool changes_picture_only = false) const {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < nacre_shader_left_out_count(get()); ++i) {
      int changes_picture = 0;
      const char* line = nacre_shader_left_out(get(), i, &changes_picture);
      if (changes_picture != 0 || !changes_picture_only) lines.emplace_back(line);
    }
    return lines;
  }
  /// CompileOptions::facts, with what they save.
  std::vector<FactInfo> facts() const {
    std::vector<FactInfo> list;
    for (std::size_t i = 0; i < nacre_shader_fact_count(get()); ++i) {
      nacre_fact_info one{};
      one.size = sizeof one;
      detail::check(nacre_shader_fact(get(), i, &one));
      const auto saved =
          one.saved != NACRE_NOT_KNOWN ? std::optional<std::uint64_t>(one.saved) : std::nullopt;
      list.push_back({{one.name, one.minimum, one.maximum}, saved});
    }
    return list;
  }
  /// Points so far that facts were not true of, with those of their blocks.
  std::uint64_t points_outside_facts() const { return nacre_shader_points_outside_facts(get()); }
  /// Nothing where neither max_error nor measure_error asked for it.
  std::optional<ShaderError> error() const {
    nacre_shader_error_info one{};
    one.size = sizeof one;
    if (nacre_shader_error(get(), &one) != NACRE_OK) return std::nullopt;
    return ShaderError{one.mean,  one.p999, one.maximum, one.worst, one.floor, one.is_absolute != 0,
                       one.points};
  }
  /// What max_error has chosen, for CompileOptions::profile; "": it was not asked for.
  std::string profile() const {
    const char* const text = nacre_shader_profile(get());
    return text != nullptr ? text : "";
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
        return from != nullptr ? detail::numbers_of(one, from) : std::vector<float>();
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
  /// The numbers that it has by now; integers and booleans as numbers.
  std::vector<float> value(const std::string& parameter) const {
    nacre_parameter about{};
    const std::size_t index = find(parameter, about);
    if (index == SIZE_MAX) refuse(parameter, "read: the shader has none of that name");
    std::vector<std::uint32_t> numbers(static_cast<std::size_t>(about.components));
    detail::check(nacre_instance_get(get(), index, numbers.data()));
    return detail::numbers_of(about, numbers.data());
  }
  nacre_instance* get() const { return instance_.get(); }

 private:
  /// SIZE_MAX where the shader has none of that name.
  std::size_t find(const std::string& name, nacre_parameter& about) const {
    const std::size_t index = nacre_shader_find_parameter(shader_, name.c_str());
    about.size = sizeof about;
    if (index != SIZE_MAX) detail::check(nacre_shader_parameter(shader_, index, &about));
    return index;
  }
  [[noreturn]] static void refuse(const std::string& name, const std::string& why) {
    Diagnostic said;
    said.code = "bad-parameter";
    said.path = name;
    said.text = said.message = "'" + name + "' cannot be " + why;
    throw Error(NACRE_WRONG_ARGUMENTS, {said});
  }
  void set_numbers(const std::string& name, const void* values, std::size_t count, int type) {
    nacre_parameter about{};
    const std::size_t index = find(name, about);
    const bool is_known = index != SIZE_MAX;
    const bool fits = is_known && about.number_type == type &&
                      static_cast<std::size_t>(about.components) == count;
    if (!fits) {
      refuse(name, "set to that: the shader has " +
                       (is_known ? std::string("a ") + about.type : "none of that name"));
    }
    detail::check(nacre_instance_set(get(), index, values));
  }

  const nacre_shader* shader_;
  detail::Owned<nacre_instance, nacre_instance_destroy> instance_;
};

}  // namespace v0
}  // namespace nacre

#endif
