#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <bit>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "examples/tool/inspect/cost.h"
#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "examples/tool/recorded_option.h"
#include "jit/graph/find.h"
#include "jit/tune/json.h"
#include "jit/tune/measure.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

struct InspectOptions {
  CommonOptions common;
  std::string material;
  std::vector<std::string> outputs;
  std::vector<std::string> dumps;
  bool live = false;
  bool fit_parameters = false;
  bool cost = false;
  bool error = false;
  RecordedOption recorded;
  bool json = false;
};

Json channel_list(const std::vector<Channel>& channels) {
  Json list = Json::array();
  for (const Channel& channel : channels) {
    list.push_back({{"name", channel.name}, {"type", scalar_name(channel.type)}});
  }
  return list;
}

/// JSON has no numbers that are not finite; those are texts: "inf", "-inf", "nan".
Json number(float value) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  return value;
}

Json parameter_list(const Program& program) {
  Json list = Json::array();
  for (const ParameterSlot& slot : program.parameters) {
    Json entry{{"name", slot.name}, {"type", scalar_name(slot.type)}};
    if (slot.type == Scalar::f32) entry["value"] = number(std::bit_cast<float>(slot.value));
    if (slot.type != Scalar::f32) entry["value"] = static_cast<std::int32_t>(slot.value);
    list.push_back(std::move(entry));
  }
  return list;
}

Json describe(const BoundKernel& kernel) {
  const Program& program = kernel.program();
  Json textures = Json::array();
  for (const TextureSlot& slot : program.textures) textures.push_back(slot.key);
  return {{"engine", kernel.kernel().engine()},         {"lanes", kernel.kernel().lanes()},
          {"instructions", instruction_count(program)}, {"functions", program.functions.size() - 1},
          {"inputs", channel_list(program.inputs)},     {"outputs", channel_list(program.outputs)},
          {"parameters", parameter_list(program)},      {"textures", std::move(textures)}};
}

Json stage_list(const std::vector<StageReport>& stages) {
  Json list = Json::array();
  for (const StageReport& stage : stages) {
    Json entry{{"stage", stage.name},
               {"milliseconds", stage.milliseconds},
               {"instructions", stage.instructions}};
    if (!stage.text.empty()) entry["text"] = stage.text;
    list.push_back(std::move(entry));
  }
  return list;
}

Json fact_list(const std::vector<FactUse>& facts) {
  Json list = Json::array();
  for (const auto& [fact, saved] : facts) {
    list.push_back({{"name", fact.name}, {"minimum", fact.low}, {"maximum", fact.high}});
    list.back()["saved"] = saved ? Json(*saved) : Json(nullptr);
  }
  return list;
}

Json lobe_names(const MaterialKernels& kernels) {
  Json names = Json::array();
  for (const LobeInfo& lobe : kernels.lobes) names.push_back(lobe.name);
  return names;
}

/// With what it costs where there is a compiler to measure with; so below.
Json inspect_material(const Opened& opened, const std::string& material,
                      const ShaderOptions& shader, Compiler* for_cost, Diagnostics& diagnostics) {
  const auto kernels =
      opened.system->compile_material(*opened.document, material, shader, diagnostics);
  if (kernels == nullptr) return nullptr;
  Json result{{"material", material},
              {"lobes", lobe_names(*kernels)},
              {"state_channels", kernels->state.size()},
              {"left_out", kernels->manifest},
              {"facts", fact_list(kernels->facts)}};
  Json list = Json::object();
  const std::pair<const char*, const std::optional<BoundKernel>*> all[]{
      {"begin", &kernels->begin},
      {"sample", &kernels->sample},
      {"evaluate", &kernels->evaluate},
      {"albedo", &kernels->albedo},
      {"emission", &kernels->emission},
      {"opacity", &kernels->opacity},
      {"volume", &kernels->volume},
      {"displacement", &kernels->displacement},
      {"light", &kernels->light},
      {"interior", &kernels->interior},
      {"subsurface", &kernels->subsurface},
      {"shadow", &kernels->shadow},
      {"emit", &kernels->emit}};
  std::vector<NamedKernel> present;
  for (const auto& [name, kernel] : all) {
    if (!kernel->has_value()) continue;
    list[name] = describe(**kernel);
    present.emplace_back(name, &**kernel);
  }
  result["kernels"] = std::move(list);
  if (for_cost != nullptr) {
    result["cost"] = kernel_costs(present, *for_cost, shader.compile, diagnostics);
  }
  result["stages"] = stage_list(kernels->stages);
  return result;
}

Json inspect_output(const Opened& opened, const std::string& output, const ShaderOptions& shader,
                    Compiler* for_cost, Diagnostics& diagnostics) {
  const auto kernel =
      opened.system->compile_outputs(*opened.document, {output}, shader, diagnostics);
  if (kernel == nullptr) return nullptr;
  Json result{{"output", output},
              {"type", type_name(kernel->outputs.front().type)},
              {"facts", fact_list(kernel->facts)},
              {"kernel", describe(kernel->kernel)}};
  if (for_cost != nullptr) {
    result["cost"] =
        kernel_costs({{output, &kernel->kernel}}, *for_cost, shader.compile, diagnostics);
  }
  result["stages"] = stage_list(kernel->stages);
  return result;
}

void print_kernel(const std::string& name, const Json& kernel) {
  fmt::print("  {}: {} instructions, {} functions, {}, {} lanes\n", name,
             kernel["instructions"].get<std::size_t>(), kernel["functions"].get<std::size_t>(),
             kernel["engine"].get<std::string>(), kernel["lanes"].get<int>());
  for (const char* list : {"inputs", "parameters"}) {
    if (kernel[list].empty()) continue;
    fmt::print("    {}:", list);
    for (const Json& entry : kernel[list]) fmt::print(" {}", entry["name"].get<std::string>());
    fmt::print("\n");
  }
  for (const Json& texture : kernel["textures"]) {
    fmt::print("    texture: {}\n", texture.get<std::string>());
  }
}

void print_facts(const Json& facts) {
  for (const Json& fact : facts) {
    fmt::print("  fact: {} in [{}, {}]: {} instructions less\n", fact["name"].get<std::string>(),
               fact["minimum"].get<double>(), fact["maximum"].get<double>(),
               fact["saved"].is_null() ? std::string("unknown, from the cache,")
                                       : fmt::format("{}", fact["saved"].get<std::size_t>()));
  }
}

void print_stages(const Json& stages) {
  for (const Json& stage : stages) {
    fmt::print("    {:28} {:8.3f} ms {:6} instructions\n", stage["stage"].get<std::string>(),
               stage["milliseconds"].get<double>(), stage["instructions"].get<std::size_t>());
    if (stage.contains("text")) fmt::print("{}\n", stage["text"].get<std::string>());
  }
}

/// How far what was compiled is off; null after a diagnostic.
Json error_of(const TuneSubject& subject, const ShaderOptions& shader,
              const std::shared_ptr<const RecordedPoints>& recorded, Diagnostics& diagnostics) {
  TuneOptions tuning;
  tuning.shader = shader;
  tuning.recorded = recorded;
  const auto measured = measure_error(subject, tuning, diagnostics);
  if (!measured) return nullptr;
  Json json = as_json(measured->error);
  json["worst"] = measured->error.worst;
  json["metric"] = "relative";
  json["floor"] = tuning.metric.floor;
  json["points"] = measured->points;
  return json;
}

void print_error(const Json& error) {
  const auto text = [&](const char* name) {
    const Json& x = error[name];
    return x.is_string() ? x.get<std::string>() : fmt::format("{:.2g}", x.get<double>());
  };
  fmt::print("  error: {} in the mean, {} but for one of a thousand, at most {} ({})\n",
             text("mean"), text("p999"), text("maximum"), text("worst"));
  fmt::print("    relative, with a floor of {} of the largest; at {}\n", text("floor"),
             text("points"));
}

void print_text(const Json& result) {
  if (result.contains("material")) {
    fmt::print("material {}\n", result["material"].get<std::string>());
    for (const Json& lobe : result["lobes"]) fmt::print("  lobe {}\n", lobe.get<std::string>());
    for (const Json& line : result["left_out"]) {
      fmt::print("  left out: {}\n", line.get<std::string>());
    }
    fmt::print("  state: {} channels a point\n", result["state_channels"].get<std::size_t>());
    for (const auto& [name, kernel] : result["kernels"].items()) print_kernel(name, kernel);
  } else {
    fmt::print("output {} ({})\n", result["output"].get<std::string>(),
               result["type"].get<std::string>());
    print_kernel("kernel", result["kernel"]);
  }
  print_facts(result["facts"]);
  if (result.contains("cost")) print_costs(result["cost"]);
  if (result.contains("error") && !result["error"].is_null()) print_error(result["error"]);
  fmt::print("  stages:\n");
  print_stages(result["stages"]);
}

int run(const InspectOptions& options) {
  Diagnostics diagnostics;
  std::shared_ptr<const RecordedPoints> recorded;
  Opened opened;
  if (options.recorded.read(recorded, diagnostics)) opened = open(options.common, diagnostics);
  if (!opened) {
    if (options.json) print_json(Json::array());
    return report(diagnostics);
  }
  ShaderOptions shader = options.common.shader_options();
  if (options.cost && shader.compile.backend != Backend::jit) {
    diagnostics.error("bad-option", {}, "--cost measures compiled code", "--backend jit",
                      options.common.backend);
    if (options.json) print_json(Json::array());
    return report(diagnostics);
  }
  const auto for_cost = options.cost ? options.common.compiler() : nullptr;
  shader.compile.whole = true;
  if (options.live) shader.parameters = ParameterMode::live;
  shader.fit_parameters = options.fit_parameters;
  for (const std::string& dump : options.dumps) {
    if (dump == "program") shader.compile.keep_text = true;
    if (dump == "llvm") shader.compile.dump_ir = true;
    if (dump == "assembly") shader.compile.dump_assembly = true;
  }
  Json results = Json::array();
  const auto add = [&](const std::string& name, bool is_material) {
    const ShaderOptions own = with_profile(opened, name, is_material, shader, diagnostics);
    Json result = is_material ? inspect_material(opened, name, own, for_cost.get(), diagnostics)
                              : inspect_output(opened, name, own, for_cost.get(), diagnostics);
    if (result.is_null()) return;
    if (options.error) {
      const TuneSubject subject{opened.system.get(), opened.document.get(), {name}, is_material};
      result["error"] = error_of(subject, own, recorded, diagnostics);
    }
    results.push_back(std::move(result));
  };
  const bool everything = options.material.empty() && options.outputs.empty();
  if (!options.material.empty()) add(options.material, true);
  if (everything) {
    for (const FoundMaterial& found : find_materials(*opened.document)) add(found.name, true);
  }
  for (const std::string& output : options.outputs) add(output, false);
  if (everything) {
    for (const FoundOutput& found : find_outputs(*opened.document)) {
      if (is_numeric(found.type)) add(found.name, false);
    }
  }
  if (options.json) {
    print_json(results);
  } else {
    for (const Json& result : results) print_text(result);
  }
  return report(diagnostics);
}

}  // namespace

void add_inspect(CLI::App& app, int& status) {
  auto options = std::make_shared<InspectOptions>();
  CLI::App& command = *app.add_subcommand(
      "inspect", "Show what kernels need, hold and leave out, and how they were made");
  options->common.add_document(command);
  command.add_option("--material", options->material, "One material (default: all)")
      ->type_name("NAME");
  command.add_option("--output", options->outputs, "A graph output (default: all)")
      ->type_name("NAME");
  command.add_option("--dump", options->dumps, "Also the text of a stage; may be repeated")
      ->check(CLI::IsMember({"program", "llvm", "assembly"}));
  command.add_flag("--cost", options->cost,
                   "Run the kernels and say what time each node, lobe and function takes");
  command.add_flag("--error", options->error,
                   "Measure how far numbers are from double precision with everything exact");
  options->recorded.add(command);
  command.get_option("--recorded")->needs(command.get_option("--error"));
  CLI::Option* const live = command.add_flag("--live", options->live, "Keep parameters changeable");
  command
      .add_flag("--fit-parameters", options->fit_parameters,
                "What depends on parameters and one number is read from polynomials, which are "
                "fitted when the parameters change")
      ->needs(live);
  command.add_flag("--json", options->json,
                   "For programs to read: a list with an object for each material and output");
  options->common.add_compile(command);
  options->common.add_lobes(command);
  options->common.add_profile(command);
  command.callback([options, &status] {
    status = guarded(options->common.file, [&] { return run(*options); });
  });
}

}  // namespace nacre::tool
