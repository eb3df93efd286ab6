#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "examples/bake/plane_tiles.h"
#include "examples/bake/write_texture.h"
#include "examples/common/image_writer.h"
#include "examples/tool/bake/document.h"
#include "examples/tool/bake/ledger.h"
#include "examples/tool/bake/manifest_request.h"
#include "examples/tool/bake/material_inputs.h"
#include "examples/tool/bake/mesh_options.h"
#include "examples/tool/bake/not_finite.h"
#include "examples/tool/bake/output_compilation.h"
#include "examples/tool/bake/report.h"
#include "examples/tool/bake/sampling_request.h"
#include "examples/tool/bake/target.h"
#include "examples/tool/bake/texture_request.h"
#include "examples/tool/bake/udim.h"
#include "examples/tool/file_stems.h"
#include "examples/tool/number_range.h"
#include "examples/tool/options.h"
#include "examples/tool/output_files.h"
#include "examples/tool/process.h"
#include "examples/tool/stop.h"
#include "jit/graph/find.h"
#include "runtime/near_names.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

/// As far as every whole number is a float.
constexpr double largest_whole = 1 << 24;

struct BakeOptions {
  CommonOptions common;
  std::vector<std::string> outputs;
  std::string material;
  std::string document;
  TextureRequest textures;
  SamplingRequest sampling;
  ManifestRequest manifest;
  bool average = false;
  MeshOptions mesh;
  bool report = false;
  bool json = false;
  std::string out;   ///< "": beside the document that is written, or here.
  std::string udim;  ///< --udim: numbers, or "auto".
  std::optional<host::UvArea> window;
  float frame = 1.0f;
  float time = 0.0f;
};

/// Every numeric output of the document, or what the command line names.
std::vector<std::string> wanted(const BakeOptions& options, const Opened& opened,
                                Diagnostics& diagnostics) {
  const SourceLocation file{options.common.file, 0, 0, {}};
  if (!options.material.empty()) {
    std::vector<std::string> inputs =
        material_inputs(opened, options.material, !options.common.strict, diagnostics);
    if (inputs.empty() && !diagnostics.has_errors()) {
      diagnostics.error("nothing-to-bake", file,
                        fmt::format("no graph feeds the surface shader of '{}'", options.material),
                        "an input that the output of a graph feeds");
    }
    return inputs;
  }
  std::vector<std::string> names;
  for (const std::string& name : options.outputs) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (!names.empty()) return names;
  for (const FoundOutput& output : find_outputs(*opened.document)) {
    if (is_numeric(output.type)) names.push_back(output.name);
  }
  if (names.empty()) {
    diagnostics.error("nothing-to-bake", file, "the document has no numeric output");
  }
  return names;
}

/// The <output> of that name, or null.
const Element* output_element(const Document& document, const std::string& name) {
  const Element* element = find_element(document, name);
  return element != nullptr && element->category() == "output" ? element : nullptr;
}

/// One output, and the files it is to be in: one for each tile.
struct Piece {
  std::string name;
  SourceLocation where;
  TextureSettings texture;
  std::vector<BakeItem> items;
  std::vector<BakeStep> steps;  ///< What there is to do about each.

  bool has(BakeStep step) const { return std::ranges::find(steps, step) != steps.end(); }
};

std::vector<Piece> pieces(const BakeOptions& options, const Opened& opened,
                          const host::BakeSettings& settings, const std::vector<UdimTile>& tiles,
                          BakeLedger& ledger, Diagnostics& diagnostics) {
  std::vector<Piece> all;
  FileStems stems;
  for (const std::string& name : wanted(options, opened, diagnostics)) {
    const Element* output = output_element(*opened.document, name);
    Piece piece{.name = name,
                .where = {options.common.file, 0, 0, name},
                .texture = {},
                .items = {},
                .steps = {}};
    if (output != nullptr) piece.where = location(*output);
    if (!texture_settings(options.textures, output, piece.texture, diagnostics)) continue;
    piece.texture.encoding.is_tile = !tiles.empty();
    piece.texture.encoding.output = name;
    const std::string stem = stems.stem_of(name, piece.where, diagnostics);
    const auto add = [&](const std::string& number, const UdimTile& tile) {
      const fs::path path = fs::path(options.out) /
                            file_name(options.textures.name, stem, number, piece.texture.extension);
      piece.items.push_back(
          ledger.item(path.string(), settings_of(name, piece.texture, settings, tile)));
      piece.steps.push_back(ledger.step(piece.items.back(), diagnostics));
    };
    if (tiles.empty()) add("", {});
    for (const UdimTile& tile : tiles) add(tile.number(), tile);
    all.push_back(std::move(piece));
  }
  return all;
}

/// Says what is known of files that are there already.
void report_kept(const Piece& piece, const BakeTarget& target, const BakeLedger& ledger,
                 BakeReport& report) {
  for (std::size_t i = 0; i < piece.items.size(); ++i) {
    if (piece.steps[i] != BakeStep::keep) continue;
    report.add(kept_map(piece.items[i].path, ledger.record(piece.items[i]), piece.texture,
                        target.surface() != nullptr, ledger.is_merging()));
  }
}

/// One output into its files.
void bake_piece(const BakeOptions& options, const Opened& opened, const Piece& piece,
                host::BakeSettings settings, const std::vector<UdimTile>& tiles,
                OutputCompilation& compilation, BakeLedger& ledger, BakeTarget& target,
                BakeReport& report, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const auto [graph, kernel] = compilation.finish(diagnostics);
  if (kernel == nullptr) return;
  if (!target.prepare(*graph, kernel->kernel.program(), false, piece.where)) return;
  settings.width = piece.texture.width;
  settings.height = piece.texture.height;
  const Type type = kernel->outputs[0].type;
  warn_of_no_mean(settings.sampling, type, piece.where, diagnostics);
  for (std::size_t i = 0; i < piece.items.size(); ++i) {
    if (piece.steps[i] != BakeStep::bake) continue;
    const std::string& path = piece.items[i].path;
    if (!tiles.empty()) settings.corner_u = tiles[i].u;
    if (!tiles.empty()) settings.corner_v = tiles[i].v;
    if (!target.lay_out(settings)) return;
    const OutputKernel loaded =
        host::with_tiles(*kernel, 0, settings, opened.system->textures(), diagnostics);
    const std::array<const BoundKernel*, 1> kernels{&loaded.kernel};
    if (!check_output({"the map of " + piece.name, path}, kernels, diagnostics)) return;
    ProgressLine line(fs::path(path).stem().string(), options.common.quiet);
    const host::BakeControl control{.stop = stop().token(),
                                    .progress = [&](double share) { line.update(share); }};
    const Stopwatch watch;
    host::TextureReport said;
    said.histogram = options.json;
    if (host::bake_to_file(loaded, 0, settings, piece.texture.encoding, path, diagnostics, control,
                           &said)) {
      report_not_finite(said.statistics, piece.where, diagnostics);
      file_is_written(path, options.common.quiet || options.json);
      const BakedMap map{path,
                         piece.name,
                         type,
                         piece.texture,
                         said.statistics,
                         watch.seconds(),
                         settings.surface != nullptr};
      report.add(map);
      // What lacks an image, say, is written, but not finished.
      const bool is_right = is_sound(*opened.system, errors, diagnostics);
      if (is_right && !ledger.add(piece.items[i], record_of(map), loaded.kernel, diagnostics)) {
        return;
      }
    }
    if (stop().is_due()) return;
  }
  report_code(kernel->kernel, compilation.shader(), diagnostics);
}

void bake_outputs(const BakeOptions& options, const Opened& opened,
                  const host::BakeSettings& settings, const std::vector<UdimTile>& tiles,
                  ShaderOptions shader, BakeLedger& ledger, BakeTarget& target, BakeReport& report,
                  Diagnostics& diagnostics) {
  const std::vector<Piece> all = pieces(options, opened, settings, tiles, ledger, diagnostics);
  for (const Piece& piece : all) {
    report_kept(piece, target, ledger, report);
    for (std::size_t i = 0; i < piece.items.size(); ++i) {
      if (piece.steps[i] != BakeStep::bake) continue;
      const std::array<OutputFile, 2> files{{{"the map of " + piece.name, piece.items[i].path},
                                             {"--manifest", options.manifest.file}}};
      if (!check_outputs(files, opened.document->files(), diagnostics)) return;
      promise_files({piece.items[i].path});
      if (!host::prepare_image(piece.items[i].path, diagnostics)) return;
    }
  }
  std::vector<const Piece*> wanted;
  for (const Piece& piece : all) {
    if (piece.has(BakeStep::bake)) wanted.push_back(&piece);
  }
  const auto compilation_of = [&](std::size_t i) -> std::unique_ptr<OutputCompilation> {
    if (i >= wanted.size()) return nullptr;
    const TextureSettings& texture = wanted[i]->texture;
    shader.graph.output_space = host::output_space(texture.extension, texture.encoding);
    return std::make_unique<OutputCompilation>(opened, wanted[i]->name, shader);
  };
  std::unique_ptr<OutputCompilation> next = compilation_of(0);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (stop().is_due()) return;
    // The one after it is compiled while this one is baked.
    const std::unique_ptr<OutputCompilation> now = std::exchange(next, compilation_of(i + 1));
    bake_piece(options, opened, *wanted[i], settings, tiles, *now, ledger, target, report,
               diagnostics);
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
    diagnostics.error(
        "unknown-material", {options.common.file, 0, 0, {}},
        options.material.empty() ? "the document has no material"
                                 : fmt::format("there is no material '{}'", options.material),
        {}, {}, near_hint(diagnostics, options.material, find_materials(document), [](auto& each) {
          return std::string_view(each.name);
        }));
  }
  return names;
}

/// Where textures go that nobody gave a place: beside the document they are of.
std::string texture_folder(const BakeOptions& options) {
  if (!options.out.empty()) return options.out;
  const fs::path beside = fs::path(options.document).parent_path();
  return beside.empty() ? "." : beside.string();
}

/// All that was asked for; the status.
int bake_all(BakeOptions& options, host::BakeSettings& settings, BakeReport& told,
             Diagnostics& diagnostics) {
  keep_freed_memory();
  options.out = texture_folder(options);
  settings.threads = options.common.threads;
  settings.window = options.window;
  settings.frame = options.frame;
  settings.time = options.time;
  const Opened opened = open(options.common, diagnostics);
  if (!opened) return report(diagnostics);
  BakeTarget target(options.mesh.open(options.time, diagnostics), options.mesh.is_viewed(),
                    diagnostics);
  if (diagnostics.has_errors()) return report(diagnostics);
  settings.surface = target.surface();
  const std::vector<UdimTile> tiles =
      target.surface() != nullptr
          ? read_tiles(options.udim, *target.surface(), options.mesh.scene, diagnostics)
          : read_tiles(options.udim, *opened.document, options.common.search_paths, diagnostics,
                       options.common.allow_outside);
  if (diagnostics.has_errors()) return report(diagnostics);
  if (!check_file_name(options.textures.name, !tiles.empty(), diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  ShaderOptions shader = options.common.shader_options();
  shader.graph.frame = static_cast<int>(options.frame);
  // What stands for images that cannot be had is decided while compiling.
  // Which tiles a mesh reads is not known before.
  shader.defer_tiles = shader.missing_images == MissingImages::error && target.surface() == nullptr;
  target.prepare(shader);
  options.textures.document = document_digest(*opened.document);
  BakeManifest head;
  if (options.manifest.is_asked() && !describe_inputs(options.common, opened, head, diagnostics)) {
    return report(diagnostics);
  }
  if (options.manifest.is_asked() && target.surface() != nullptr) {
    options.mesh.describe(*target.surface(), head);
  }
  BakeLedger ledger(options.manifest, options.out, options.common.file, std::move(head));
  if (!ledger.open(diagnostics)) return report(diagnostics);
  if (options.document.empty()) {
    bake_outputs(options, opened, settings, tiles, shader, ledger, target, told, diagnostics);
    ledger.finish(diagnostics);
    report_texels(*opened.system, diagnostics);
    return report(diagnostics);
  }
  shader.graph.working_space = "lin_rec709";  // What the textures are tagged with.
  const DocumentBake bake{options.document,
                          wanted_materials(options, *opened.document, diagnostics),
                          options.out,
                          options.textures,
                          settings,
                          tiles,
                          shader,
                          options.mesh.uv_set,
                          options.common.quiet || options.json,
                          options.manifest.shard.has_value(),
                          options.average};
  if (!bake.materials.empty()) bake_document(bake, opened, ledger, target, told, diagnostics);
  ledger.finish(diagnostics);
  report_texels(*opened.system, diagnostics);
  return report(diagnostics);
}

int run(BakeOptions& options) {
  Diagnostics diagnostics;
  host::BakeSettings settings;
  if (!options.textures.check(diagnostics) || !options.manifest.check(diagnostics) ||
      !options.mesh.read(settings.dilation, diagnostics) ||
      !options.sampling.read(settings.sampling, diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  const std::array<OutputFile, 2> outputs{
      {{"--document", options.document}, {"--manifest", options.manifest.file}}};
  if (!check_outputs(outputs, {}, diagnostics)) {
    report(diagnostics);
    return status_usage;
  }
  BakeReport told(options.json     ? BakeReport::Form::json
                  : options.report ? BakeReport::Form::text
                                   : BakeReport::Form::none);
  // Also of what failed: who reads it finds a document.
  const int status = bake_all(options, settings, told, diagnostics);
  told.print();
  return status;
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
  CLI::Option* document =
      command
          .add_option("--document", options->document,
                      "Write a document too, in which textures and values stand for the graphs "
                      "that feed --material, or every material")
          ->type_name("FILE.mtlx")
          ->excludes(outputs);
  command
      .add_flag("--average", options->average,
                "With --document, values alone: of each map the mean of its texels")
      ->needs(document);
  options->textures.add(command);
  options->sampling.add(command);
  options->manifest.add(command);
  options->mesh.add(command);
  CLI::Option* text =
      command.add_flag("--report", options->report,
                       "Say of each map how long it took, its samples, and the range and mean of "
                       "each channel; what is the same everywhere is said to be uniform");
  command
      .add_flag("--json", options->json,
                "For programs to read: an object with what --report says and histograms, in place "
                "of the names of files")
      ->excludes(text);
  CLI::Option* tiles =
      command
          .add_option("--udim", options->udim,
                      "Tiles, an image each: numbers as 1001,1002, or auto for those of the "
                      "document's udimset or images (default: one image of uv from 0 to 1)")
          ->type_name("N,N...|auto");
  command
      .add_option_function<std::vector<float>>(
          "--window",
          [options](const std::vector<float>& corners) {
            const host::UvArea area{.u = corners[0],
                                    .v = corners[1],
                                    .width = corners[2] - corners[0],
                                    .height = corners[3] - corners[1]};
            if (!(area.width > 0.0f && area.height > 0.0f)) {
              throw CLI::ValidationError("--window", "it is empty: X1 above X0 and Y1 above Y0");
            }
            options->window = area;
          },
          "The part of uv that an image shows, from its lower left to its upper right corner "
          "(default: 0 0 1 1)")
      ->expected(4)
      ->check(number_within(-largest_whole, largest_whole))
      ->type_name("X0 Y0 X1 Y1")
      ->excludes(tiles)
      ->excludes(document)
      ->excludes(command.get_option("--scene"));
  command
      .add_option("--out", options->out,
                  "Folder for the images, made where there is none (default: that of --document, "
                  "or the current one)")
      ->type_name("DIR");
  command.add_option("--frame", options->frame, "Frame number")
      ->check(number_within(-largest_whole, largest_whole))
      ->capture_default_str();
  command.add_option("--time", options->time, "Seconds")
      ->check(number_within(-largest_whole, largest_whole))
      ->capture_default_str();
  command.footer(
      "Without --scene graphs are baked on a plane: texel (i, j) of a W x H image, j from the top, "
      "has uv = "
      "((i+1/2)/W, 1-(j+1/2)/H) in every set, position (u, v, 0), normal (0, 0, 1), tangent "
      "(1, 0, 0), bitangent (0, 1, 0) and a viewer straight above; more samples lie in the texel's "
      "square; vertex colours are 0, "
      "properties have their defaults. What reads more than uv is named in a warning.\n\n"
      "With --scene a texel that a triangle touches is shaded at its middle, or at the triangle's "
      "point next to it; of more samples those on triangles count. Positions, frames, vertex "
      "colours and properties are the mesh's, footprints its texels'. Properties that "
      "graphs may read by name (geompropvalue), made from rays into the whole scene and from the "
      "mesh: ambientocclusion (float, 1 where nothing is near), bentnormal (vector3, unit, world "
      "space: the mean direction that is open), curvature (float, mean, 1/unit, positive where "
      "convex) and thickness (float, units, mean length of rays inwards).");
  options->common.add_compile(command);
  options->common.add_profile(command);
  options->common.add_waiting(command);
  command.callback([options, &status] {
    status = guarded(options->common.file, [&] { return run(*options); });
  });
}

}  // namespace nacre::tool
