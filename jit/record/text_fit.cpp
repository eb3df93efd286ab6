#include "jit/record/text_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nacre {

bool misfit(const SourceLocation& where, Diagnostics& diagnostics, std::string message,
            std::string expected, std::string found) {
  diagnostics.error("source-misfit", where, std::move(message), std::move(expected),
                    std::move(found));
  return false;
}

std::optional<glsl::Value> fitted(const FittedParameter& fit, const SourceLocation& where,
                                  Diagnostics& diagnostics) {
  const glsl::Value& value = fit.port.value;
  const glsl::Type& type = fit.parameter.type;
  const bool converts = fit.is_input && glsl::converts(value.type, type);
  if (converts && fit.parameter.in) return glsl::convert(value, type);
  std::optional<SourceMisfit> difference = find_misfit(value.type, type);
  const bool has_direction = fit.is_input ? fit.parameter.in : fit.parameter.out;
  if (!difference && has_direction) {
    return fit.is_input ? glsl::Value{type, value.parts, {}} : glsl::zero(type);
  }
  if (!difference) difference = {to_string(type), to_string(type)};
  misfit(where, diagnostics,
         fmt::format("parameter {} of function '{}' does not fit {} '{}'", fit.number, fit.function,
                     fit.is_input ? "input" : "output", fit.port.name),
         (fit.is_input ? "" : "out ") + difference->expected,
         (fit.parameter.out ? "out " : "") + difference->found);
  return std::nullopt;
}

void say_once(const std::string& path, const Diagnostics& found, Diagnostics& diagnostics) {
  for (Diagnostic one : found.all()) {
    if (one.where.path.empty()) one.where.path = path;
    const auto is_same = [&](const Diagnostic& other) {
      return other.where.line == one.where.line && other.where.column == one.where.column &&
             other.code == one.code && other.where.file == one.where.file &&
             other.where.path == one.where.path && other.message == one.message;
    };
    const std::vector<Diagnostic>& said = diagnostics.all();
    if (std::none_of(said.begin(), said.end(), is_same)) diagnostics.add(std::move(one));
  }
}

}  // namespace nacre
