#include "jit/api/exactness.h"

#include <optional>
#include <utility>

#include "jit/api/call.h"
#include "jit/api/handles.h"
#include "jit/tune/profile.h"
#include "jit/tune/recorded_points.h"

namespace nacre::api {

namespace {

/// What kernels compute, without what hosts ask of them besides, which has no error of its own.
ShaderOptions plain(ShaderOptions options) {
  KernelRequest& kernels = options.kernels;
  KernelRequest asked;
  asked.entries = kernels.entries;
  // What they compute at once others do one by one.
  if ((kernels.entries & (entry_shade | entry_evaluate_at)) != 0) {
    asked.entries |= entry_sample | entry_evaluate;
  }
  if ((kernels.entries & entry_shadow) != 0) asked.entries |= entry_opacity;
  if ((kernels.entries & entry_emit) != 0) asked.entries |= entry_emission;
  asked.lobes = kernels.lobes;
  asked.energy_conserving = kernels.energy_conserving;
  asked.compensation = kernels.compensation;
  kernels = asked;
  options.live_footprints = false;
  return options;
}

std::optional<TuneOptions> tune_options(const nacre_compile_options& asked,
                                        const ShaderOptions& options, Diagnostics& diagnostics) {
  TuneOptions made;
  made.max_error = asked.max_error;
  made.metric.is_relative = asked.error_is_absolute == 0;
  if (asked.error_floor > 0) made.metric.floor = asked.error_floor;
  if (asked.error_points != 0) made.points = asked.error_points;
  made.shader = plain(options);
  made.seconds_a_kernel = 0;
  if (asked.error_record == nullptr) return made;
  auto recorded = RecordedPoints::parse(asked.error_record, "error_record", diagnostics);
  if (!recorded) return std::nullopt;
  made.recorded = std::make_shared<const RecordedPoints>(std::move(*recorded));
  return made;
}

bool apply_profile_of(const char* text, const TuneSubject& subject, ShaderOptions& options,
                      Diagnostics& diagnostics) {
  if (text == nullptr) return true;
  const std::optional<Profile> profile = Profile::parse(text, "profile", diagnostics);
  if (profile) {
    apply_profile(*profile, subject.names, subject.is_material, options, diagnostics);
  }
  return profile.has_value();
}

/// One subject for each output, as profiles name them.
std::vector<TunedSubject> by_name(const TuneSubject& subject, const Tuned& tuned) {
  std::vector<TunedSubject> all;
  for (const std::string& name : subject.names) {
    all.push_back({name, subject.is_material, tuned});
  }
  return all;
}

}  // namespace

bool choose_exactness(const nacre_compile_options& asked, const TuneSubject& subject,
                      ShaderOptions& options, std::shared_ptr<const ShaderError>& error,
                      Diagnostics& diagnostics) {
  if (!apply_profile_of(asked.profile, subject, options, diagnostics)) return false;
  if (asked.max_error == 0 && asked.measure_error == 0) return true;
  const auto tuning = tune_options(asked, options, diagnostics);
  if (!tuning) return false;
  if (asked.max_error == 0) {
    auto measured = measure_error(subject, *tuning, diagnostics);
    if (!measured) return false;
    error =
        std::make_shared<const ShaderError>(ShaderError{std::move(*measured), tuning->metric, {}});
    return true;
  }
  const std::optional<Tuned> tuned = tune(subject, *tuning, diagnostics);
  if (!tuned) return false;
  apply_choices(tuned->chosen.choices, options);
  error = std::make_shared<const ShaderError>(
      ShaderError{{*tuned->chosen.unseen_error, tuned->points},
                  tuning->metric,
                  profile_text(by_name(subject, *tuned), *tuning)});
  return true;
}

}  // namespace nacre::api

using nacre::api::ShaderError;

nacre_status nacre_shader_error(const nacre_shader* shader, nacre_shader_error_info* info) {
  if (shader == nullptr) return NACRE_WRONG_ARGUMENTS;
  const ShaderError* const known = shader->error.get();
  if (known == nullptr) return NACRE_FAILED;
  const nacre::Error& error = known->measured.error;
  return nacre::api::give(info, {.size = 0,
                                 .mean = error.mean,
                                 .p999 = error.p999,
                                 .maximum = error.maximum,
                                 .worst = error.worst.c_str(),
                                 .floor = known->metric.floor,
                                 .is_absolute = known->metric.is_relative ? 0 : 1,
                                 .points = known->measured.points.c_str()});
}

const char* nacre_shader_profile(const nacre_shader* shader) {
  if (shader == nullptr || shader->error == nullptr || shader->error->profile.empty()) {
    return nullptr;
  }
  return shader->error->profile.c_str();
}
