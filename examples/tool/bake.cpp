#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <stop_token>

#include "examples/bake/write_texture.h"
#include "examples/tool/bake_document.h"
#include "examples/tool/material_inputs.h"
#include "examples/tool/options.h"
#include "examples/tool/stop.h"
#include "examples/tool/texture_request.h"
#include "examples/tool/udim.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

struct BakeOptions {
  CommonOptions common;
  std::vector<std::string> outputs;
  std::string material;
  std::string document;
  TextureRequest textures;
  std::string out = ".";
  std::string udim;  ///< --udim: numbers, or "auto".
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

/// The <output> of that name, or null.
const Element* output_element(const Document& document, const std::string& name) {
  const std::size_t slash = name.find('/');
  const Element* element = document.root().child(name.substr(0, slash));
  if (slash != std::string::npos && element != nullptr)
    element = element->child(name.substr(slash + 1));
  return element != nullptr && element->category() == "output" ? element : nullptr;
}

/// One output into one file.
void bake_file(const BakeOptions& options, const OutputKernel& kernel, const std::string& stem,
               const host::BakeSettings& settings, const TextureSettings& texture,
               const std::stop_token& stop, Diagnostics& diagnostics) {
  const std::string path = (fs::path(options.out) / (stem + texture.extension)).string();
  ProgressLine line(stem, options.common.quiet);
  const host::BakeControl control{.stop = stop,
                                  .progress = [&](double share) { line.update(share); }};
  if (host::bake_to_file(kernel, 0, settings, texture.encoding, path, diagnostics, control) &&
      !options.common.quiet) {
    fmt::print("{}\n", path);
  }
}

void bake_outputs(const BakeOptions& options, const Opened& opened, host::BakeSettings settings,
                  const std::vector<UdimTile>& tiles, ShaderOptions shader,
                  const std::stop_token& stop, Diagnostics& diagnostics) {
  for (const std::string& name : wanted(options, opened, diagnostics)) {
    if (stop.stop_requested()) break;
    TextureSettings texture;
    if (!texture_settings(options.textures, output_element(*opened.document, name), texture,
                          diagnostics)) {
      continue;
    }
    texture.encoding.is_tile = !tiles.empty();
    shader.graph.output_space = host::output_space(texture.extension, texture.encoding);
    const auto kernel =
        opened.system->compile_outputs(*opened.document, {name}, shader, diagnostics);
    if (kernel == nullptr) continue;
    settings.width = texture.width;
    settings.height = texture.height;
    if (tiles.empty()) {
      bake_file(options, *kernel, file_stem(name), settings, texture, stop, diagnostics);
    }
    for (const UdimTile& tile : tiles) {
      settings.corner_u = tile.u;
      settings.corner_v = tile.v;
      const std::string stem = file_stem(name) + "." + tile.number();
      bake_file(options, *kernel, stem, settings, texture, stop, diagnostics);
    }
  }
}

/// The material asked for, or all of the document.
std::vector<std::string> wanted_materials(const BakeOptions& options, const Document& document,
                                          Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const FoundMaterial& found : find_materials(document)) {
    if (options.material.empty() || options.material == found.name) names.push_back(found.name);
  }
  if (names.empty()) {
    diagnostics.error("unknown-material", {options.common.file, 0, 0, {}},
                      options.material.empty()
                          ? "the document has no material"
                          : fmt::format("there is no material '{}'", options.material));
  }
  return names;
}

int run(const BakeOptions& options) {
  Diagnostics diagnostics;
  if (!options.textures.check(diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  host::BakeSettings settings;
  settings.threads = options.common.threads;
  settings.frame = options.frame;
  settings.time = options.time;
  const Opened opened = open(options.common, diagnostics);
  if (!opened) return report(diagnostics);
  const std::vector<UdimTile> tiles =
      read_tiles(options.udim, *opened.document, options.common.search_paths, diagnostics,
                 options.common.allow_outside);
  if (diagnostics.has_errors()) return report(diagnostics);
  std::error_code status;
  fs::create_directories(options.out, status);
  ShaderOptions shader = options.common.shader_options();
  shader.graph.frame = static_cast<int>(options.frame);
  const StopOnSignal stop;
  if (options.document.empty()) {
    bake_outputs(options, opened, settings, tiles, shader, stop.token(), diagnostics);
  } else {
    shader.graph.working_space = "lin_rec709";  // What the textures are tagged with.
    const DocumentBake bake{
        options.document, wanted_materials(options, *opened.document, diagnostics),
        options.out,      options.textures,
        settings,         tiles,
        shader,           options.common.quiet};
    if (!bake.materials.empty()) bake_document(bake, opened, stop.token(), diagnostics);
  }
  report_texels(*opened.system, diagnostics);
  return report(diagnostics);
}

}  // namespace

void add_bake(CLI::App& app, int& status) {
  auto options = std::make_shared<BakeOptions>();
  CLI::App& command = *app.add_subcommand("bake", "Write graph outputs as textures");
  options->common.add_document(command);
  CLI::Option* outputs =
      command
          .add_option("--output", options->outputs,
                      "An output: GRAPH/NAME, or NAME at the root; may be repeated (default: all)")
          ->type_name("NAME");
  command
      .add_option("--material", options->material,
                  "The inputs of this material's surface shader that graphs feed")
      ->type_name("NAME");
  command
      .add_option("--document", options->document,
                  "Write a document too, in which textures and values stand for the graphs that "
                  "feed --material, or every material")
      ->type_name("FILE.mtlx")
      ->excludes(outputs);
  options->textures.add(command);
  command
      .add_option("--udim", options->udim,
                  "Tiles, an image each: numbers as 1001,1002, or auto for those of the "
                  "document's udimset or images (default: one image of uv from 0 to 1)")
      ->type_name("N,N...|auto");
  command.add_option("--out", options->out, "Folder for the images")->capture_default_str();
  command.add_option("--frame", options->frame, "Frame number")->capture_default_str();
  command.add_option("--time", options->time, "Seconds")->capture_default_str();
  options->common.add_compile(command);
  command.callback([options, &status] { status = run(*options); });
}

}  // namespace nacre::tool
