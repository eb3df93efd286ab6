#include "bench/accuracy/report.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

namespace nacre {

namespace {

std::string argument_text(const Largest& largest, int arguments) {
  const auto show = [](std::uint32_t bits) {
    return fmt::format("{}", std::bit_cast<float>(bits));
  };
  if (arguments == 1) return show(largest.x);
  return show(largest.x) + ", " + show(largest.y);
}

std::string row(const MathReport& report, std::size_t mode, const ErrorStatistics& errors,
                const std::string& name) {
  const OperationCount& operations = report.operations[mode];
  const std::string rare = operations.rare > 0 ? fmt::format(" (+{})", operations.rare) : "";
  const std::string wrong = errors.wrong > 0 ? fmt::format("{} ({:08x}, {:08x})", errors.wrong,
                                                           errors.wrong_x, errors.wrong_y)
                                             : "";
  return fmt::format("| {} | {} | {}{} | {:.3g} | {} | {:.2e} | {:.2e} | {} |\n", name,
                     accuracy_name(accuracy_modes[mode]), operations.always, rare, errors.ulp.error,
                     argument_text(errors.ulp, report.function->arguments), errors.relative.error,
                     errors.absolute.error, wrong);
}

nlohmann::json largest_json(const Largest& largest, int arguments) {
  nlohmann::json json{{"error", largest.error}, {"x", fmt::format("{:08x}", largest.x)}};
  if (arguments == 2) json["y"] = fmt::format("{:08x}", largest.y);
  return json;
}

nlohmann::json errors_json(const ErrorStatistics& errors, int arguments) {
  return {{"count", errors.count},
          {"ulp", largest_json(errors.ulp, arguments)},
          {"relative", largest_json(errors.relative, arguments)},
          {"absolute", largest_json(errors.absolute, arguments)},
          {"wrong", errors.wrong}};
}

}  // namespace

std::string to_markdown(const std::vector<MathReport>& reports) {
  std::string text =
      "| function | mode | operations (rare) | max ulp | at | max relative | max absolute | wrong "
      "|\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const MathReport& report : reports) {
    const MathFunction& function = *report.function;
    for (std::size_t mode = 0; mode < accuracy_modes.size(); ++mode) {
      const ModeErrors& errors = report.result.modes[mode];
      text += row(report, mode, errors.all, function.name);
      if (!std::isinf(function.near)) {
        text +=
            row(report, mode, errors.near, fmt::format("{}, to {}", function.name, function.near));
      }
    }
  }
  return text;
}

std::string to_json(const std::vector<MathReport>& reports, const SweepOptions& options,
                    const std::string& engine) {
  nlohmann::json list = nlohmann::json::array();
  for (const MathReport& report : reports) {
    const MathFunction& function = *report.function;
    for (std::size_t mode = 0; mode < accuracy_modes.size(); ++mode) {
      const ModeErrors& errors = report.result.modes[mode];
      nlohmann::json entry{{"function", function.name},
                           {"mode", accuracy_name(accuracy_modes[mode])},
                           {"operations", report.operations[mode].always},
                           {"rare_operations", report.operations[mode].rare},
                           {"all", errors_json(errors.all, function.arguments)}};
      if (!std::isinf(function.near)) {
        entry["near"] = errors_json(errors.near, function.arguments);
        entry["near"]["limit"] = function.near;
      }
      list.push_back(std::move(entry));
    }
  }
  const nlohmann::json document{{"engine", engine},
                                {"stride", options.stride},
                                {"pairs", options.pairs},
                                {"functions", std::move(list)}};
  return document.dump(2) + "\n";
}

}  // namespace nacre
