#include "jit/tune/tune.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "examples/common/atomic_file.h"
#include "examples/tool/number_range.h"
#include "examples/tool/options.h"
#include "examples/tool/output_files.h"
#include "examples/tool/process.h"
#include "examples/tool/recorded_option.h"
#include "examples/tool/stop.h"
#include "examples/tool/tune/front_plot.h"
#include "jit/graph/find.h"
#include "jit/tune/json.h"
#include "jit/tune/profile.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

struct ToolOptions {
  CommonOptions common;
  std::vector<std::string> materials;
  std::vector<std::string> outputs;
  std::string out;
  std::string plot;
  double time_limit = 0;
  RecordedOption recorded;
  TuneOptions tune;
  bool has_times = true;
  bool json = false;
};

Json as_json(const Candidate& candidate) {
  Json json{{"choices", nacre::as_json(candidate.choices)},
            {"cost", candidate.cost},
            {"error", nacre::as_json(candidate.error)},
            {"worst", candidate.error.worst}};
  if (candidate.unseen_error) json["unseen_error"] = nacre::as_json(*candidate.unseen_error);
  if (candidate.nanoseconds > 0) json["nanoseconds"] = candidate.nanoseconds;
  return json;
}

Json as_json(const TunedSubject& subject) {
  Json front = Json::array();
  for (const Candidate& each : subject.tuned.front) front.push_back(as_json(each));
  return {{subject.is_material ? "material" : "output", subject.name},
          {"points", subject.tuned.points},
          {"front", std::move(front)},
          {"standard", as_json(subject.tuned.standard)},
          {"chosen", as_json(subject.tuned.chosen)}};
}

void print_candidate(const char* mark, const Candidate& candidate) {
  const std::string time =
      candidate.nanoseconds > 0 ? fmt::format("{:.2f}", candidate.nanoseconds) : "";
  fmt::print("  {:1} {:>8} {:>8.0f} {:>9.2g} {:>9.2g}  {}\n", mark, time, candidate.cost,
             candidate.error.p999, candidate.error.maximum, to_string(candidate.choices));
}

void print_tuned(const TunedSubject& subject, const TuneOptions& options) {
  const Tuned& tuned = subject.tuned;
  fmt::print("{} {}\n", subject.is_material ? "material" : "output", subject.name);
  fmt::print("  {:1} {:>8} {:>8} {:>9} {:>9}  {}\n", "", "ns", "cost", "p99.9", "maximum",
             "choices");
  for (const Candidate& each : tuned.front) {
    print_candidate(each.choices == tuned.chosen.choices ? "*" : "", each);
  }
  const auto is_chosen = [&](const Candidate& each) {
    return each.choices == tuned.chosen.choices;
  };
  if (std::ranges::none_of(tuned.front, is_chosen)) print_candidate("*", tuned.chosen);
  const Error& unseen = *tuned.chosen.unseen_error;
  // What costs nothing is not cheaper than nothing.
  const auto share = [](double of, double whole) { return whole > 0 ? of / whole : 1; };
  fmt::print("  * for an error of {:g}: {:.2f} of the cost of standard", options.max_error,
             share(tuned.chosen.cost, tuned.standard.cost));
  if (tuned.chosen.nanoseconds > 0 && tuned.standard.nanoseconds > 0) {
    fmt::print(", {:.2f} of its time", share(tuned.chosen.nanoseconds, tuned.standard.nanoseconds));
  }
  fmt::print("; at other points {:.2g}, at most {:.2g}\n", unseen.p999, unseen.maximum);
  fmt::print("  at {}\n", tuned.points);
}

std::vector<TuneSubject> subjects(const ToolOptions& options, const Opened& opened) {
  std::vector<TuneSubject> all;
  const auto add = [&](const std::string& name, bool is_material) {
    const auto is_it = [&](const TuneSubject& each) {
      return each.text() == name && each.is_material == is_material;
    };
    if (std::ranges::any_of(all, is_it)) return;
    all.push_back({opened.system.get(), opened.document.get(), {name}, is_material});
  };
  for (const std::string& name : options.materials) add(name, true);
  for (const std::string& name : options.outputs) add(name, false);
  if (!options.materials.empty() || !options.outputs.empty()) return all;
  for (const FoundMaterial& found : find_materials(*opened.document)) add(found.name, true);
  for (const FoundOutput& found : find_outputs(*opened.document)) {
    if (is_numeric(found.type)) add(found.name, false);
  }
  return all;
}

int run(ToolOptions& options) {
  Diagnostics diagnostics;
  const std::array<OutputFile, 2> outputs{{{"--profile", options.out}, {"--plot", options.plot}}};
  if (!check_outputs(outputs, {options.common.file, options.recorded.file}, diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  promise_files({options.out, options.plot});
  for (const std::string& file : {options.out, options.plot}) {
    if (file.empty() || host::prepare_output(file, diagnostics)) continue;
    if (options.json) print_json(Json::array());
    return report(diagnostics);
  }
  Opened opened;
  if (options.recorded.read(options.tune.recorded, diagnostics)) {
    opened = open(options.common, diagnostics);
  }
  if (!opened || !check_outputs(outputs, opened.document->files(), diagnostics)) {
    if (options.json) print_json(Json::array());
    return report(diagnostics);
  }
  TuneOptions& tuning = options.tune;
  tuning.shader = options.common.shader_options();
  if (!options.has_times) tuning.seconds_a_kernel = 0;
  if (options.time_limit > 0) tuning.enough = Stop().within(options.time_limit);
  const std::vector<TuneSubject> all = subjects(options, opened);
  if (all.empty()) {
    diagnostics.error("nothing-to-tune", {options.common.file, 0, 0, {}},
                      "the document has neither a material nor a numeric output");
  }
  std::vector<TunedSubject> done;
  for (const TuneSubject& subject : all) {
    std::optional<Tuned> tuned;
    {
      ProgressLine line(subject.text(), options.common.quiet);
      tuning.progress = [&](double share) { line.update(share); };
      tuned = tune(subject, tuning, diagnostics);
    }
    if (stop().is_due()) break;
    if (!tuned) continue;
    if (tuned->is_cut_short) {
      diagnostics.warning("cut-short", {.file = {}, .path = subject.text()},
                          "not all ways were tried: a cheaper one may be as exact",
                          "all within the time (--time-limit)",
                          fmt::format("{:g} s are over", options.time_limit));
    }
    done.push_back({subject.text(), subject.is_material, std::move(*tuned)});
    if (!options.json) print_tuned(done.back(), tuning);
  }
  if (options.json) {
    Json results = Json::array();
    for (const TunedSubject& each : done) results.push_back(as_json(each));
    print_json(results);
  }
  // Half a profile would leave the rest to chance.
  const auto write = [&](const std::string& file, auto&& text) {
    if (file.empty() || diagnostics.has_errors() || stop().is_due()) return;
    if (!host::write_text_atomically(file, text(), diagnostics)) return;
    file_is_written(file, options.common.quiet || options.json);
  };
  write(options.out, [&] { return profile_text(done, tuning); });
  write(options.plot, [&] { return front_plot(done, tuning.max_error); });
  return report(diagnostics);
}

}  // namespace

void add_tune(CLI::App& app, int& status) {
  auto options = std::make_shared<ToolOptions>();
  CLI::App& command = *app.add_subcommand(
      "tune", "Find the cheapest kernels that keep an error, and what more exact ones cost");
  options->common.add_document(command);
  command
      .add_option("--material", options->materials, "A material; may be repeated (default: all)")
      ->type_name("NAME");
  command
      .add_option("--output", options->outputs, "A graph output; may be repeated (default: all)")
      ->type_name("NAME");
  command
      .add_option("--max-error", options->tune.max_error,
                  "What all numbers but one of a thousand are off by at most, and each by three "
                  "times that, measured against double precision with everything exact")
      ->check(number_within(0))
      ->capture_default_str()
      ->type_name("X");
  const std::map<std::string, bool> metrics{{"relative", true}, {"absolute", false}};
  command
      .add_option("--metric", options->tune.metric.is_relative,
                  "Whether an error is a share of the number, or of --floor times the largest "
                  "number where it is less than that; or the difference")
      ->transform(
          CLI::CheckedTransformer(metrics, CLI::ignore_case).description("{relative,absolute}"))
      ->default_str("relative")
      ->type_name("METRIC");
  command.add_option("--floor", options->tune.metric.floor, "See --metric")
      ->check(number_within(0, 1))
      ->capture_default_str();
  command.add_option("--points", options->tune.points, "At how many points errors are measured")
      ->check(CLI::Range(std::size_t{1000}, std::size_t{1000000}))
      ->capture_default_str();
  options->recorded.add(command);
  command
      .add_option("--profile", options->out,
                  "Write what was chosen, for --profile of bake, inspect and render")
      ->type_name("OUT.json");
  command
      .add_option(
          "--plot", options->plot,
          "Draw the fronts: a line a material or output, error over time, a disc on what was "
          "chosen, a ring on standard")
      ->type_name("OUT.svg");
  command
      .add_option(
          "--time-limit", options->time_limit,
          "Seconds for all of them: then no more ways are tried, which is said, and what is "
          "chosen is of those that were (default: 0, none)")
      ->check(number_within(0, 1e9))
      ->type_name("S");
  command.add_flag("!--no-times", options->has_times,
                   "Do not compile and run what was found to say how long it takes");
  command.add_flag("--json", options->json,
                   "For programs to read: a list with an object for each material and output");
  options->common.add_machine(command);
  command.callback([options, &status] {
    status = guarded(options->common.file, [&] { return run(*options); });
  });
}

}  // namespace nacre::tool
