#include "examples/tool/bake/sampling_request.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "examples/tool/number_range.h"

namespace nacre::tool {

void SamplingRequest::add(CLI::App& command) {
  command
      .add_option("--samples", samples,
                  "Samples in each texel, whose mean it is: a number, or auto for as many as "
                  "--texel-error asks for; image look-ups and derivatives are of areas as wide as "
                  "they lie apart")
      ->type_name("N|auto")
      ->capture_default_str();
  CLI::Option* error = command
                           .add_option("--texel-error", texel_error,
                                       "With --samples auto, the estimated error of a texel that "
                                       "is small enough, of numbers above 1 relative to them")
                           ->check(number_within(1e-6, 1.0))
                           ->type_name("X")
                           ->default_str("0.00196, half a step of 8 bits");
  error->each([this](const std::string& /*text*/) { has_error = true; });
}

bool SamplingRequest::read(host::Sampling& sampling, Diagnostics& diagnostics) const {
  sampling = {};
  sampling.error = texel_error;
  if (samples == "auto") {
    sampling.count = 0;
    return true;
  }
  if (has_error) {
    diagnostics.error("bad-option", {}, "--texel-error says how many samples are enough",
                      "--samples auto", "--samples " + samples);
    return false;
  }
  const char* end = samples.data() + samples.size();
  const auto [last, problem] = std::from_chars(samples.data(), end, sampling.count);
  if (problem == std::errc{} && last == end && sampling.count >= 1 &&
      sampling.count <= most_samples) {
    return true;
  }
  diagnostics.error("bad-option", {}, "--samples cannot be understood",
                    fmt::format("1 to {}, or auto", most_samples), samples);
  return false;
}

void warn_of_no_mean(const host::Sampling& sampling, Type type, const SourceLocation& where,
                     Diagnostics& diagnostics) {
  if (sampling.count == 1 || host::has_mean(type)) return;
  diagnostics.warning(
      "no-mean", where,
      fmt::format("an output of type {} has no mean: one sample is taken in a texel",
                  type_name(type)),
      "an output of floats");
}

}  // namespace nacre::tool
