#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <stop_token>

#include "examples/bake/write_texture.h"
#include "examples/tool/material_inputs.h"
#include "examples/tool/options.h"
#include "examples/tool/size.h"
#include "examples/tool/stop.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

struct BakeOptions {
  CommonOptions common;
  std::vector<std::string> outputs;
  std::string material;
  std::string size = "1024";
  std::string out = ".";
  std::string format = "exr";
  float frame = 1.0f;
  float time = 0.0f;
};

/// "NG_marble/out" becomes "NG_marble.out".
std::string file_stem(const std::string& output) {
  std::string name = output;
  for (char& c : name) {
    if (c == '/' || c == ':') c = '.';
  }
  return name;
}

/// Every numeric output of the document, or what the command line names.
std::vector<std::string> wanted(const BakeOptions& options, const Opened& opened,
                                Diagnostics& diagnostics) {
  if (!options.material.empty()) {
    return material_inputs(*opened.document, options.material, diagnostics);
  }
  if (!options.outputs.empty()) return options.outputs;
  std::vector<std::string> names;
  for (const FoundOutput& output : find_outputs(*opened.document)) {
    if (is_numeric(output.type)) names.push_back(output.name);
  }
  if (names.empty()) {
    diagnostics.error("nothing-to-bake", {options.common.file, 0, 0, {}},
                      "the document has no numeric output");
  }
  return names;
}

int run(const BakeOptions& options) {
  Diagnostics diagnostics;
  host::BakeSettings settings;
  if (!parse_size(options.size, settings.width, settings.height, diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  settings.threads = options.common.threads;
  settings.frame = options.frame;
  settings.time = options.time;
  const Opened opened = open(options.common, diagnostics);
  if (!opened) return report(diagnostics);
  const std::vector<std::string> names = wanted(options, opened, diagnostics);
  std::error_code status;
  fs::create_directories(options.out, status);
  ShaderOptions shader = options.common.shader_options();
  shader.graph.frame = static_cast<int>(options.frame);
  const StopOnSignal stop;
  for (const std::string& name : names) {
    if (stop.token().stop_requested()) break;
    const auto kernel =
        opened.system->compile_outputs(*opened.document, {name}, shader, diagnostics);
    if (kernel == nullptr) continue;
    const std::string path =
        (fs::path(options.out) / (file_stem(name) + "." + options.format)).string();
    ProgressLine line(name, options.common.quiet);
    const host::BakeControl control{.stop = stop.token(),
                                    .progress = [&](double share) { line.update(share); }};
    if (host::bake_to_file(*kernel, 0, settings, path, diagnostics, control) &&
        !options.common.quiet) {
      fmt::print("{}\n", path);
    }
  }
  return report(diagnostics);
}

}  // namespace

void add_bake(CLI::App& app, int& status) {
  auto options = std::make_shared<BakeOptions>();
  CLI::App& command = *app.add_subcommand("bake", "Write graph outputs as textures");
  options->common.add_document(command);
  command.add_option("--output", options->outputs, "An output: GRAPH/NAME, or NAME at the root; "
                                                   "may be repeated (default: all)")
      ->type_name("NAME");
  command.add_option("--material", options->material,
                     "The inputs of this material's surface shader that graphs feed")
      ->type_name("NAME");
  command.add_option("--size", options->size, "Texels: N or WxH")->capture_default_str();
  command.add_option("--out", options->out, "Folder for the images")->capture_default_str();
  command.add_option("--format", options->format, "exr and tx hold floats, png 8 bits")
      ->check(CLI::IsMember({"exr", "png", "tx"}))
      ->capture_default_str();
  command.add_option("--frame", options->frame, "Frame number")->capture_default_str();
  command.add_option("--time", options->time, "Seconds")->capture_default_str();
  options->common.add_compile(command);
  command.callback([options, &status] { status = run(*options); });
}

}  // namespace nacre::tool
