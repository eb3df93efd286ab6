#include <nacre/lobe_test.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "jit/api/call.h"
#include "jit/api/share.h"
// What hosts in C++ test with, which asks the library through its interface.
#include <nacre/lobe_test.hpp>
#include <nacre/nacre.hpp>

struct nacre_lobe_report {
  nacre::LobeReport found;
};

namespace {

template <class T>
void take(T& to, T given) {
  if (given != T{}) to = given;
}

nacre::LobeTestOptions options_of(const nacre_lobe_test_options& given) {
  nacre::LobeTestOptions options;
  if (given.wo != nullptr) {
    options.wo.clear();
    for (std::size_t i = 0; i < given.wo_count; ++i) {
      options.wo.push_back({given.wo[i][0], given.wo[i][1], given.wo[i][2]});
    }
  }
  take(options.samples, static_cast<std::size_t>(given.samples));
  take(options.seed, given.seed);
  take(options.most_energy, given.most_energy);
  take(options.albedo_error, given.albedo_error);
  take(options.weight_error, given.weight_error);
  take(options.unit_error, given.unit_error);
  if (given.bind != nullptr) {
    options.bind = [bind = given.bind, user = given.bind_user](nacre::Binder& binder) {
      bind(user, binder.get());
    };
  }
  return options;
}

/// The numbers of another instance of the same shader.
void copy_values(const nacre_instance* from, const nacre_shader* shader, nacre_instance* to) {
  std::uint32_t numbers[16];
  for (std::size_t i = 0; i < nacre_shader_parameter_count(shader); ++i) {
    nacre_parameter about{};
    about.size = sizeof about;
    const bool fits = nacre_shader_parameter(shader, i, &about) == NACRE_OK &&
                      about.components <= static_cast<int>(std::size(numbers));
    if (fits && nacre_instance_get(from, i, numbers) == NACRE_OK)
      nacre_instance_set(to, i, numbers);
  }
}

void give_direction(float (&to)[3], nacre::Direction from) {
  to[0] = from.x, to[1] = from.y, to[2] = from.z;
}

}  // namespace

nacre_status nacre_test_lobes(const nacre_shader* shader, const nacre_lobe_test_options* given,
                              nacre_report* report, nacre_lobe_report** found) {
  if (found == nullptr) return NACRE_WRONG_ARGUMENTS;
  *found = nullptr;
  if (shader == nullptr || !nacre::api::has_size(given)) return NACRE_WRONG_ARGUMENTS;
  for (const nacre_entry entry : {NACRE_SAMPLE, NACRE_EVALUATE, NACRE_ALBEDO}) {
    if (nacre_shader_has(shader, entry) == 0) return NACRE_WRONG_ARGUMENTS;
  }
  return nacre::api::guarded(report, [&] {
    const nacre_lobe_test_options asked = nacre::api::options_of(given);
    nacre::LobeTestOptions options = options_of(asked);
    const nacre::Shader of = nacre::Shader::adopt(nacre::api::share(shader));
    nacre::Instance instance(of);
    if (asked.instance != nullptr) {
      copy_values(asked.instance, shader, instance.get());
      options.instance = &instance;
    }
    *found = new nacre_lobe_report{nacre::test_lobes(of, options)};
    return NACRE_OK;
  });
}

void nacre_lobe_report_destroy(nacre_lobe_report* found) { delete found; }

size_t nacre_lobe_report_fault_count(const nacre_lobe_report* found) {
  return found != nullptr ? found->found.faults.size() : 0;
}

nacre_status nacre_lobe_report_fault(const nacre_lobe_report* found, size_t index,
                                     nacre_lobe_fault* fault) {
  if (index >= nacre_lobe_report_fault_count(found)) return NACRE_WRONG_ARGUMENTS;
  const nacre::LobeFault& from = found->found.faults[index];
  nacre_lobe_fault one{};
  one.law = from.law.c_str();
  give_direction(one.wo, from.wo);
  one.found = from.found;
  one.expected = from.expected;
  one.text = from.text.c_str();
  return nacre::api::give(fault, one);
}

size_t nacre_lobe_report_view_count(const nacre_lobe_report* found) {
  return found != nullptr ? found->found.views.size() : 0;
}

nacre_status nacre_lobe_report_view(const nacre_lobe_report* found, size_t index,
                                    nacre_lobe_view* view) {
  if (index >= nacre_lobe_report_view_count(found)) return NACRE_WRONG_ARGUMENTS;
  const nacre::LobeView& from = found->found.views[index];
  nacre_lobe_view one{};
  give_direction(one.wo, from.wo);
  std::ranges::copy(from.energy, one.energy);
  one.deviation = from.deviation;
  std::ranges::copy(from.albedo, one.albedo);
  one.valid = from.valid;
  one.chi_square = from.chi_square;
  one.reciprocity = from.reciprocity;
  one.is_too_thin = from.is_too_thin ? 1 : 0;
  return nacre::api::give(view, one);
}
