#include "examples/tool/inspect/cost.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "examples/measure/kernel_cost.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

/// Long enough for some thousand looks at each kernel.
constexpr double seconds_a_kernel = 1.0;
/// Share of the time from which on a part is named.
constexpr double worth_a_line = 0.005;

Json as_json(const measure::KernelCost& cost) {
  Json rows = Json::array();
  for (const measure::CostRow& row : cost.rows) {
    rows.push_back({{"origin", row.origin},
                    {"function", row.function},
                    {"operations", row.operations},
                    {"nanoseconds", row.nanoseconds}});
  }
  return {{"nanoseconds", cost.nanoseconds},
          {"samples", cost.samples},
          {"outside", cost.other},
          {"parts", std::move(rows)}};
}

std::string name_of(const Json& row) {
  const auto origin = row["origin"].get<std::string>();
  const auto function = row["function"].get<std::string>();
  const std::string who = origin.empty() ? "(inputs, outputs, loop)" : origin;
  return function.empty() ? who : fmt::format("{}() of {}", function, who);
}

void print_cost(const std::string& name, const Json& cost) {
  const auto all = cost["nanoseconds"].get<double>();
  fmt::print("  cost of {}: {:.2f} ns a point, from {} samples\n", name, all,
             cost["samples"].get<std::size_t>());
  fmt::print("    {:>8} {:>6} {:>10}  {}\n", "ns", "%", "operations", "node, lobe or function");
  const auto line = [&](double ns, const std::string& operations, const std::string& what) {
    fmt::print("    {:8.2f} {:6.1f} {:>10}  {}\n", ns, all > 0 ? 100 * ns / all : 0, operations,
               what);
  };
  std::size_t rest = 0, rest_operations = 0;
  double rest_nanoseconds = 0;
  for (const Json& row : cost["parts"]) {
    const auto ns = row["nanoseconds"].get<double>();
    const auto operations = row["operations"].get<std::size_t>();
    if (ns >= worth_a_line * all) {
      line(ns, std::to_string(operations), name_of(row));
      continue;
    }
    ++rest;
    rest_operations += operations;
    rest_nanoseconds += ns;
  }
  if (rest != 0) {
    line(rest_nanoseconds, std::to_string(rest_operations),
         fmt::format("({} others, of less than {} % each)", rest, 100 * worth_a_line));
  }
  line(cost["outside"].get<double>(), "", "(outside: batches, look-ups on the host)");
}

}  // namespace

Json kernel_costs(const std::vector<NamedKernel>& kernels, Compiler& compiler,
                  const CompileOptions& options, Diagnostics& diagnostics) {
  Json costs = Json::object();
  Columns given;
  for (const auto& [name, kernel] : kernels) {
    const auto cost =
        measure::measure_cost(*kernel, compiler, options, given, seconds_a_kernel, diagnostics);
    costs[name] = cost ? as_json(*cost) : Json(nullptr);
    if (cost) given.insert(cost->results.begin(), cost->results.end());
  }
  return costs;
}

void print_costs(const Json& costs) {
  for (const auto& [name, cost] : costs.items()) {
    if (!cost.is_null()) print_cost(name, cost);
  }
}

}  // namespace nacre::tool
