#include "examples/tool/options.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "examples/common/materialx_libraries.h"
#include "examples/tool/fact_option.h"
#include "examples/tool/number_range.h"
#include "examples/tool/stop.h"
#include "jit/cache/kernel_cache.h"
#include "jit/document/read.h"
#include "jit/graph/color/color_config.h"
#include "jit/graph/color/colorspace.h"
#include "runtime/read_file.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

/// Threads are asked for by people, who have machines of hundreds of cores; beyond that it
/// is a mistake.
constexpr int most_threads = 1024;

// Groups of options in help.
constexpr const char* how_exact = "How exact kernels are";
constexpr const char* what_runs = "Colours, code and threads";

}  // namespace

void CommonOptions::add_document(CLI::App& command) {
  command.add_option("FILE", file, "MaterialX document")->required()->type_name("FILE.mtlx");
  command.option_defaults()->group("The document and its images");
  command.add_option("--library", libraries, "Further node definitions: a file or folder")
      ->type_name("DIR");
  command.add_option("--search-path", search_paths, "Where includes and images are looked for too")
      ->type_name("DIR");
  command.add_flag("--allow-outside", allow_outside,
                   "Let includes and images lie anywhere, not only below the folder of FILE, a "
                   "--search-path or a --library");
  const std::map<std::string, MissingImages> missing{{"error", MissingImages::error},
                                                     {"default", MissingImages::use_default}};
  command
      .add_option("--missing-images", missing_images,
                  "What an image is that cannot be had: an error, or with a warning its node's "
                  "default; the default is used in either case")
      ->transform(CLI::CheckedTransformer(missing, CLI::ignore_case))
      ->default_str("error")
      ->type_name("error|default");
  const std::map<std::string, Preference> preferences{
      {"body", Preference::body}, {"graph", Preference::graph}, {"source", Preference::source}};
  command
      .add_option("--prefer", graph_limits.prefer,
                  "Which implementation of a node to take: body (built in), graph, source (GLSL)")
      ->transform(CLI::CheckedTransformer(preferences, CLI::ignore_case)
                      .description("{body,graph,source}"))  // Not the numbers behind them.
      ->default_str("body")
      ->type_name("KIND");
  command
      .add_option("--ocio", ocio,
                  "OpenColorIO configuration whose colour spaces count before those built in; "
                  "env: the one that the environment variable OCIO names")
      ->type_name("FILE");
  CLI::Option* lenient = command.add_flag_callback(
      "--lenient", [] {},
      "Read what the standard has no meaning for, but MaterialX makes "
      "code of, as that code has it, with a warning for each. So it is "
      "without --strict");
  command.add_flag("--strict", strict, "Refuse what the standard has no meaning for")
      ->excludes(lenient);
  command.add_flag("-q,--quiet", quiet, "No progress on standard error");
  command
      .add_option("--texture-memory", texture_limits.budget,
                  "Bytes of images in memory at once (64MB, 2GB); those that there is no room for "
                  "are read piece by piece")
      ->transform(as_size())
      ->type_name("SIZE")
      ->default_str("2GB");
  add_limits(command);
  command.option_defaults()->group("Options");
}

void CommonOptions::add_limits(CLI::App& command) {
  const auto add = [&](const char* flag, auto& value, const char* what) {
    return command.add_option(flag, value, what)
        ->capture_default_str()
        ->group("Limits, beyond which a document or image is refused (sizes: 64MB, 2GB)");
  };
  const auto add_size = [&](const char* flag, auto& value, const char* what) {
    add(flag, value, what)->transform(as_size())->type_name("SIZE");
  };
  const auto add_count = [&](const char* flag, auto& value, const char* what) {
    add(flag, value, what)->check(number_within(0))->type_name("N");
  };
  add_size("--max-file-size", read_limits.file_bytes, "Bytes of one document file");
  add_size("--max-total-size", read_limits.total_bytes, "Bytes of a document with its includes");
  add_count("--max-files", read_limits.files, "Files of a document with its includes");
  add_count("--max-include-depth", read_limits.include_depth, "Includes within includes");
  add_count("--max-xml-depth", read_limits.xml_depth, "Elements within elements");
  add_count("--max-elements", read_limits.elements, "Elements of one file");
  add_count("--max-inheritance", read_limits.inheritance,
            "Nodedefs, nodes, looks or types that inherit from one another");
  add_count("--max-nodes", graph_limits.max_nodes, "Nodes of a graph, and of all graphs in it");
  add_count("--max-inputs", graph_limits.max_inputs, "Inputs of one node");
  add_count("--max-instructions", compile_limits.max_instructions, "Instructions of a kernel");
  add_count("--max-steps", compile_limits.max_steps,
            "Steps (roughly instructions) that a kernel takes for each pass of points");
  add("--max-compile-time", compile_limits.max_seconds,
      "Seconds to compile for; then a kernel is interpreted")
      ->check(number_within(0))
      ->type_name("S");
  add_count("--max-image-side", texture_limits.limits.max_size, "Pixels of an image on a side");
  add_size("--max-image-size", texture_limits.limits.max_bytes, "Bytes of an image, decoded");
  add_size("--max-image-file-size", texture_limits.limits.max_file_bytes, "Bytes of an image file");
  add_count("--max-image-channels", texture_limits.limits.max_channels,
            "Channels of an image file");
  add_count("--max-image-layers", texture_limits.limits.max_layers,
            "Parts, pages or levels of an image file");
  add_count("--max-image-expansion", texture_limits.limits.max_expansion,
            "Bytes of pixels for each byte of the file, of images above 256 MB in memory");
  add_count("--max-tiles", texture_limits.tiles.max_tiles, "Files that a <UDIM> name stands for");
}

void CommonOptions::add_lobes(CLI::App& command) {
  command.option_defaults()->group(how_exact);
  const std::map<std::string, Compensation> compensations{{"all", Compensation::all},
                                                          {"nothing", Compensation::nothing},
                                                          {"reflection", Compensation::reflection}};
  command
      .add_option("--compensation", compensation,
                  "Light that several scatterings between facets bring back: all, of reflection "
                  "alone (rough glass is darker), or nothing (rough metals too)")
      ->transform(CLI::CheckedTransformer(compensations, CLI::ignore_case)
                      .description("{all,nothing,reflection}"))
      ->default_str("all");
  command.option_defaults()->group("Options");
}

void CommonOptions::add_compile(CLI::App& command) {
  add_exactness(command);
  add_machine(command);
  command.option_defaults()->group(what_runs);
  add_facts(command, facts);
  command.option_defaults()->group("Options");
}

void CommonOptions::add_exactness(CLI::App& command) {
  command.option_defaults()->group(how_exact);
  command.add_option("--accuracy", accuracy, "Error promised for every function and closure")
      ->check(CLI::IsMember({"precise", "standard", "fast"}))
      ->capture_default_str();
  command.add_option("--backend", backend, "Engine that runs the kernels")
      ->check(CLI::IsMember({"jit", "interpreter", "reference"}))
      ->capture_default_str();
  command
      .add_option("--anisotropy", anisotropy,
                  "How much longer than wide a pixel may be on an image without blur; 1: no care")
      ->check(CLI::Range(1, largest_anisotropy))
      ->capture_default_str();
  command.add_flag("--fade-noise", fade_noise,
                   "noise2d, noise3d and fractals fade where a pixel covers their cells: less "
                   "flicker, and octaves that nobody can see cost nothing");
  command.option_defaults()->group("Options");
}

void CommonOptions::add_machine(CLI::App& command) {
  command.option_defaults()->group(what_runs);
  command.add_option("--lanes", lanes, "Points side by side in compiled code (default: by CPU)")
      ->check(CLI::IsMember({1, 4, 8, 16}));
  command.add_option("--threads", threads, "Threads (default: as many as the machine has)")
      ->check(number_within(0, most_threads));
  command.add_option("--cache", cache, "Folder of compiled kernels (default: in the user's cache)")
      ->type_name("DIR");
  command
      .add_option("--working-space", working_space,
                  "Colour space to compute in; \"\": the one the document's root names (default: "
                  "lin_rec709, or the role scene_linear of a configuration that has no way there)")
      ->type_name("NAME");
  command.add_flag("--no-cache", no_cache, "Neither read nor write compiled kernels");
  command.add_flag("--compile-here", compile_here,
                   "Compile in this process, which a fault of LLVM's ends; else in others");
  command.option_defaults()->group("Options");
}

void CommonOptions::add_profile(CLI::App& command) {
  command.option_defaults()->group(how_exact);
  CLI::Option* const option =
      command
          .add_option("--profile", profile,
                      "What `nacre tune` chose for the materials and outputs of this document")
          ->type_name("FILE.json");
  for (const char* chosen : {"--accuracy", "--anisotropy", "--compensation", "--fade-noise"}) {
    if (CLI::Option* const other = command.get_option_no_throw(chosen)) option->excludes(other);
  }
  command.option_defaults()->group("Options");
}

std::unique_ptr<Compiler> CommonOptions::compiler() const {
  const fs::path worker = compile_here ? fs::path() : find_worker();
  return worker.empty() ? make_compiler_here() : make_compiler_apart(worker);
}

void CommonOptions::add_waiting(CLI::App& command) {
  command.option_defaults()->group(what_runs);
  begins_at_once = true;
  command.add_flag("--wait-for-code{false}", begins_at_once,
                   "Begin when all is compiled, rather than interpret until then");
  command.option_defaults()->group("Options");
}

Accuracy CommonOptions::parsed_accuracy() const {
  if (accuracy == "precise") return Accuracy::precise;
  return accuracy == "fast" ? Accuracy::fast : Accuracy::standard;
}

Backend CommonOptions::parsed_backend() const {
  if (backend == "interpreter") return Backend::interpreter;
  return backend == "reference" ? Backend::reference : Backend::jit;
}

ShaderOptions CommonOptions::shader_options() const {
  ShaderOptions options;
  options.compile.accuracy = parsed_accuracy();
  options.kernels.compensation = compensation;
  options.compile.backend = parsed_backend();
  options.compile.lanes = lanes;
  options.compile.facts = facts;
  options.compile.max_instructions = compile_limits.max_instructions;
  options.compile.max_steps = compile_limits.max_steps;
  options.compile.max_seconds = compile_limits.max_seconds;
  options.compile.stop = stop();
  options.compile.asynchronous = begins_at_once && options.compile.backend == Backend::jit;
  options.max_anisotropy = anisotropy;
  options.fade_noise = fade_noise;
  options.graph.prefer = graph_limits.prefer;
  options.graph.lenient = !strict;
  options.graph.max_nodes = graph_limits.max_nodes;
  options.graph.max_inputs = graph_limits.max_inputs;
  options.graph.working_space = working_space;
  for (const std::string& path : search_paths) options.search_paths.emplace_back(path);
  options.files_anywhere = allow_outside;
  options.missing_images = missing_images;
  return options;
}

ReadOptions CommonOptions::read_options() const {
  ReadOptions read;
  read.limits = read_limits;
  read.stop = stop();
  for (const std::string& path : search_paths) read.search_paths.emplace_back(path);
  read.includes_anywhere = allow_outside;
  return read;
}

namespace {

/// Beyond that it is another file.
constexpr std::uint64_t most_profile_bytes = 64 << 20;

std::optional<Profile> read_profile(const std::string& file, Diagnostics& diagnostics) {
  const std::optional<std::string> text = read_file(file, most_profile_bytes, diagnostics);
  return text ? Profile::parse(*text, file, diagnostics) : std::nullopt;
}

/// All but the document.
}  // namespace

std::optional<fs::path> ocio_config(const std::string& option, Diagnostics& diagnostics) {
  if (option != "env") return fs::path(option);
  if (const char* file = std::getenv("OCIO"); file != nullptr && *file != '\0')
    return fs::path(file);
  diagnostics.error("no-color-config", {}, "--ocio env asks for the file that OCIO names",
                    "the environment variable OCIO", "none");
  return std::nullopt;
}

namespace {

/// Colours would be left as they are in one that nobody knows.
bool check_working_space(const CommonOptions& options, ShadingSystem& system,
                         Diagnostics& diagnostics) {
  const std::string name = options.working_space.value_or("");
  const std::vector<std::string_view> built_in = colorspace_names();
  if (name.empty() || name == "none" || std::ranges::find(built_in, name) != built_in.end()) {
    return true;
  }
  const auto config = system.graph_options(options.shader_options()).colors;
  if (config != nullptr && config->find(name)) return true;
  std::string known;
  for (const std::string_view each : built_in) {
    known += (known.empty() ? "" : ", ") + std::string(each);
  }
  if (config != nullptr) known += ", or one of " + config->name();
  diagnostics.error("unknown-colorspace", {.file = {}, .path = "--working-space"},
                    "there is no such colour space to compute in", known, "'" + name + "'");
  return false;
}

}  // namespace

Opened open_system(const CommonOptions& options, const FileResolver& resolver,
                   Diagnostics& diagnostics) {
  Opened opened;
  if (!options.profile.empty()) {
    opened.profile = read_profile(options.profile, diagnostics);
    if (!opened.profile) return opened;
  }
  for (const std::string& path : options.search_paths) {
    std::error_code error;
    if (fs::is_directory(path, error)) continue;
    diagnostics.warning("no-such-folder", {path, 0, 0, {}}, "nothing is found on this search path",
                        "a folder");
  }
  const fs::path data = find_materialx_libraries();
  if (data.empty()) {
    diagnostics.error("no-data-library", {}, "the MaterialX data library was not found",
                      "NACRE_MATERIALX_LIBRARIES to name the folder that holds stdlib/");
    return opened;
  }
  SystemOptions system;
  system.libraries.push_back(data);
  system.standard_texts = options.graph_limits.prefer == Preference::source;
  for (const std::string& library : options.libraries) system.libraries.emplace_back(library);
  const auto config = ocio_config(options.ocio, diagnostics);
  if (!config) return opened;
  system.ocio_config = *config;
  system.compile_threads = options.threads;
  system.compile_apart = !options.compile_here && options.parsed_backend() == Backend::jit;
  system.textures = options.texture_limits;
  if (!options.no_cache) {
    system.cache = options.cache.empty() ? default_cache_folder() : fs::path(options.cache);
  }
  system.resolver = resolver;
  opened.system = ShadingSystem::create(system, diagnostics);
  if (opened.system != nullptr && !check_working_space(options, *opened.system, diagnostics)) {
    opened.system = nullptr;
  }
  return opened;
}

Opened open(const CommonOptions& options, Diagnostics& diagnostics) {
  Opened opened = open_system(options, {}, diagnostics);
  if (opened.system == nullptr) return opened;
  opened.document = read_document(options.file, options.read_options(), diagnostics);
  return opened;
}

ShaderOptions with_profile(const Opened& opened, const std::string& name, bool is_material,
                           ShaderOptions options, Diagnostics& diagnostics) {
  if (opened.profile) apply_profile(*opened.profile, {name}, is_material, options, diagnostics);
  return options;
}

ShaderOptions reproducible(ShaderOptions options) {
  if (options.compile.accuracy == Accuracy::fast) options.compile.asynchronous = false;
  return options;
}

bool is_sound(ShadingSystem& system, std::size_t errors, const Diagnostics& diagnostics) {
  return diagnostics.error_count() == errors && system.textures().statistics().read_failures == 0;
}

void report_texels(ShadingSystem& system, Diagnostics& diagnostics) {
  const TextureStatistics found = system.textures().statistics();
  if (found.replaced_texels != 0) {
    diagnostics.warning("bad-texels", {}, "what is not finite in images counts as 0",
                        "finite numbers", std::to_string(found.replaced_texels) + " that are not");
  }
  if (found.read_failures != 0) {
    diagnostics.error("unreadable-texels", {},
                      "parts of images could not be read any more and count as 0",
                      "files that stay as they are",
                      std::to_string(found.read_failures) + " lookups that failed");
  }
}

void report_code(const BoundKernel& kernel, const ShaderOptions& options,
                 Diagnostics& diagnostics) {
  if (!options.compile.asynchronous) return;
  const Diagnostics said = kernel.diagnostics();
  for (const Diagnostic& one : said.all()) diagnostics.add(one);
}

ProgressLine::ProgressLine(std::string title, bool quiet)
    : title_(std::move(title)), active_(!quiet && isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (active_ && shown_ >= 0) std::fputs("\r\033[K", stderr);
}

void ProgressLine::update(double share) {
  const int percent = static_cast<int>(100.0 * share);
  if (!active_ || percent == shown_) return;
  shown_ = percent;
  std::fprintf(stderr, "\r%s %3d %%", title_.c_str(), percent);
  std::fflush(stderr);
}

}  // namespace nacre::tool
