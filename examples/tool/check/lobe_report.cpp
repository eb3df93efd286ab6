#include "examples/tool/check/lobe_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

/// The greatest number of all views.
template <class F>
double most(const std::vector<LobeFindings>& sets, F&& number) {
  double greatest = 0;
  for (const LobeFindings& set : sets) {
    for (const LobeView& view : set.views) greatest = std::max(greatest, number(view));
  }
  return greatest;
}

double most_light(const LobeView& view) {
  return *std::max_element(view.light.begin(), view.light.end());
}

double albedo_error(const LobeView& view) {
  double error = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    error = std::max(error, std::abs(view.albedo[k] - std::min(view.light[k], 1.0)));
  }
  return error;
}

std::string figure_of(const std::string& law, const std::vector<LobeFindings>& sets) {
  if (law == "energy") return fmt::format("most light {:.4f}", most(sets, most_light));
  if (law == "albedo") return fmt::format("largest error {:.4f}", most(sets, albedo_error));
  if (law != "samples") return {};
  const double unlikely = most(sets, [](const LobeView& view) { return 1 - view.chi_square; });
  return fmt::format("least probability {:.2g}", 1 - unlikely);
}

const LobeFault* find_fault(const LobeFindings& findings, const std::string& law) {
  const auto found = std::ranges::find(findings.faults, law, &LobeFault::law);
  return found == findings.faults.end() ? nullptr : &*found;
}

/// Whether sums were made for no view at all.
bool lacks_sums(const LobeFindings& findings) {
  return std::ranges::any_of(laws_of_numbers,
                             [&](const char* law) { return find_fault(findings, law) != nullptr; });
}

/// Whether a law was not tried of a view.
bool is_left_out(const std::string& law, const LobeFindings& findings) {
  return std::ranges::find(laws_of_density, law) != std::end(laws_of_density) &&
         std::ranges::any_of(findings.views, &LobeView::is_too_thin);
}

}  // namespace

void print_views(const std::string& title, const LobeFindings& findings) {
  if (findings.views.empty()) {
    fmt::print("{}: no closure\n", title);
    return;
  }
  fmt::print("{}: light that leaves, and what `albedo` says\n", title);
  fmt::print("  {:>7}  {:>23}  {:>23}  {:>7}  {:>11}\n", "degrees", "light", "albedo", "valid",
             "reciprocity");
  const auto colour = [](const std::array<double, 3>& rgb) {
    return fmt::format("{:7.4f} {:7.4f} {:7.4f}", rgb[0], rgb[1], rgb[2]);
  };
  for (const LobeView& view : findings.views) {
    fmt::print("  {:7.2f}  {}  {}  {:7.4f}  {:11.4g}{}\n", view.degrees, colour(view.light),
               colour(view.albedo), view.valid, view.reciprocity,
               view.is_too_thin ? "  too thin to integrate" : "");
  }
}

Json to_json(const LobeFindings& findings) {
  Json views = Json::array(), faults = Json::array();
  for (const LobeView& view : findings.views) {
    views.push_back({{"degrees", view.degrees},
                     {"light", view.light},
                     {"albedo", view.albedo},
                     {"valid", view.valid},
                     {"chi_square", view.chi_square},
                     {"reciprocity", view.reciprocity},
                     {"too_thin", view.is_too_thin}});
  }
  for (const LobeFault& fault : findings.faults) {
    faults.push_back({{"law", fault.law},
                      {"found", fault.found},
                      {"expected", fault.expected},
                      {"text", fault.text}});
  }
  return {{"views", views}, {"faults", faults}};
}

std::vector<LawResult> try_laws(const std::vector<LobeFindings>& sets) {
  using State = LawResult::State;
  std::vector<LawResult> results;
  const auto add = [&](const std::string& law, bool is_of_sums) {
    LawResult& result = results.emplace_back();
    result.law = law;
    for (std::size_t i = 0; i < sets.size() && result.state != State::broken; ++i) {
      const LobeFault* const fault = find_fault(sets[i], law);
      if (fault != nullptr) {
        result = {law, State::broken, fault->text, i};
      } else if (is_of_sums && lacks_sums(sets[i])) {
        result.state = State::not_tried;
      } else if (is_left_out(law, sets[i])) {
        result.state = State::not_tried;
        result.figure = "some are too thin to integrate";
      }
    }
    if (result.state == State::holds) result.figure = figure_of(law, sets);
  };
  for (const char* law : laws_of_numbers) add(law, false);
  for (const char* law : laws_of_sums) add(law, true);
  return results;
}

void print_laws(const std::string& title, const std::vector<LobeFindings>& sets,
                const std::vector<LawResult>& laws) {
  fmt::print("{}: laws, {} {} of inputs\n", title, sets.size(), sets.size() == 1 ? "set" : "sets");
  const auto print = [](const std::string& name, const std::string& state,
                        const std::string& figure) {
    fmt::print("  {:<11}  {}{}{}\n", name, state, figure.empty() ? "" : "  ", figure);
  };
  for (const LawResult& law : laws) {
    switch (law.state) {
      case LawResult::State::holds: print(law.law, "holds ", law.figure); break;
      case LawResult::State::not_tried: print(law.law, "not tried in all sets", law.figure); break;
      case LawResult::State::broken:
        print(law.law, "BROKEN", fmt::format("set {}, {}", law.set + 1, law.figure));
        break;
    }
  }
  const double ratio = most(sets, [](const LobeView& view) { return view.reciprocity; });
  print("reciprocity", "no law", fmt::format("greatest ratio {:.4g}", ratio));
}

}  // namespace nacre::tool
