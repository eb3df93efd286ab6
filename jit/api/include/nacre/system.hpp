/// \file
/// What documents share, and compiling them: part of <nacre/nacre.hpp>.
#ifndef NACRE_SYSTEM_HPP
#define NACRE_SYSTEM_HPP

#include <cstdint>
#include <exception>
#include <memory>
#include <memory_resource>
#include <nacre/colors.hpp>
#include <nacre/document.hpp>
#include <nacre/hooks.hpp>
#include <nacre/record.hpp>
#include <nacre/shader.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {

namespace detail {

inline nacre_body body_of(const Body& body) {
  nacre_body made{};
  made.size = sizeof made;
  made.nodedef = body.nodedef.c_str();
  if (!body.record) return made;
  made.user = new Body(body);
  made.destroy = [](void* user) { delete static_cast<Body*>(user); };
  made.record = [](void* user, nacre_node* node) {
    try {
      Node called(node);
      static_cast<Body*>(user)->record(called);
    } catch (const std::exception& thrown) {
      nacre_node_error(node, thrown.what());
    } catch (...) {
      nacre_node_error(node, "it threw something");
    }
  };
  return made;
}

}  // namespace detail

/// What a System is made of; see nacre_system_options.
struct SystemOptions {
  std::vector<std::string> libraries;  ///< Empty: the installed one.
  std::string ocio_config;
  std::string cache;
  int compile_threads = 0;
  bool compile_apart = false;
  std::uint64_t texture_memory = 0;
  std::vector<Body> bodies = {};                   ///< Nodedefs that the host implements.
  std::shared_ptr<const Colors> colors = nullptr;  ///< In place of ocio_config.
  bool standard_texts = false;
  std::uint64_t tile_memory = 0;
  int max_image_size = 0;
  std::uint64_t max_image_bytes = 0;
  std::uint64_t max_image_file_bytes = 0;
  int max_image_channels = 0;
  int max_image_layers = 0;
  std::uint64_t max_image_expansion = 0;
  std::uint64_t max_image_tiles = 0;
  FileResolver resolver = {};                   ///< Of images; for includes see ReadOptions.
  TextureSystem textures = {};                  ///< Looks images up in place of the library.
  Executor executor = {};                       ///< Runs what compiles.
  std::pmr::memory_resource* memory = nullptr;  ///< Of texels; lives as long as all shaders.
};

/// An input or output of a nodedef; see nacre_port.
struct Port {
  std::string name, type, value, geomprop, label, folder, unit, document;
  bool is_uniform = false;
};

/// A node that documents may use; see nacre_nodedef.
struct NodeDef {
  std::string name, category, group, version, document;
  std::vector<Port> inputs, outputs;
  bool has_body = false;
};

/// The folder of the installed MaterialX data library; "" if it is not there.
inline std::string data_library() { return nacre_data_library(); }

/// How a shader is compiled; see nacre_compile_options.
struct CompileOptions {
  int engine = NACRE_JIT;
  int accuracy = NACRE_STANDARD;
  int lanes = 0;
  std::vector<std::string> live;  ///< Patterns of what may change: "SR_gold/*".
  /// Patterns of those that come with each point; "exterior_index" and "texture_u", by their names.
  std::vector<std::string> varying;
  int lobes = 0;
  bool reverse_pdf = false;
  bool lobe_mask = false;
  bool by_lobe = false;
  bool min_alpha = false;
  std::uint32_t entries = 0;            ///< Bits 1 << nacre_entry.
  std::vector<std::string> with_begin;  ///< "albedo", "normal", "SR_gold/base_color".
  int side = NACRE_FRONT;
  bool background = false;
  int priority = 0;
  double max_seconds = 0;
  int max_anisotropy = 0;
  bool no_footprints = false;
  std::vector<std::string> search_paths;
  bool files_anywhere = false;
  bool missing_images_pass = false;
  bool lenient = false;
  std::string working_space, output_space;                 ///< Of colours.
  std::string distance_unit;                               ///< "": "meter".
  std::string geometry;                                    ///< Full path of what is shaded.
  std::optional<int> frame;                                ///< Of "{frame}" in file names.
  std::vector<std::pair<std::string, std::string>> names;  ///< Of "{NAME}" in them.
  std::vector<Variant> variants;
  int prefer = NACRE_BODY;
  std::uint64_t max_nodes = 0;
  std::uint64_t max_inputs = 0;
  std::uint64_t max_instructions = 0;
  std::uint64_t max_steps = 0;
  const StopSource* stop = nullptr;
  bool single_points = false;
  bool energy_conserving = false;
  bool lobes_wanted = false;     ///< A channel lobes_wanted, of sample and evaluate.
  bool transport = false;        ///< A channel transport, of sample and evaluate.
  bool live_footprints = false;  ///< Slots footprint_scale and max_anisotropy.
  bool fade_noise = false;       ///< Where footprints cover its cells.
  bool fit_parameters = false;   ///< What depends on live ones and one number; see nacre.h.
  int compensation = NACRE_COMPENSATE_ALL;
  std::string profile;     ///< The text that `nacre tune` wrote; empty: none.
  double max_error = 0;    ///< Greater than 0: the cheapest that is no further off.
  double error_floor = 0;  ///< 0: 0.01.
  bool error_is_absolute = false;
  std::uint32_t error_points = 0;  ///< 1,000 to 1,000,000; 0: 2048.
  std::string error_record;        ///< The text of `nacre render --record-points`; empty: none.
  bool measure_error = false;      ///< Shader::error() is wanted of what is asked for.
  std::vector<Fact> facts;         ///< What is known of numbers that kernels read.
};

/// The data library, textures and the compiler, for any number of documents.
class System {
 public:
  explicit System(const SystemOptions& options = {}, std::vector<Diagnostic>* said = nullptr) {
    const detail::TextList libraries(options.libraries);
    nacre_system_options asked{};
    asked.size = sizeof asked;
    asked.libraries = libraries.data();
    asked.library_count = libraries.size();
    asked.ocio_config = detail::text_or_null(options.ocio_config);
    asked.cache = detail::text_or_null(options.cache);
    asked.compile_threads = options.compile_threads;
    asked.compile_apart = options.compile_apart;
    asked.texture_memory = options.texture_memory;
    std::vector<nacre_body> bodies;
    for (const Body& body : options.bodies) bodies.push_back(detail::body_of(body));
    asked.bodies = bodies.data();
    asked.body_count = bodies.size();
    const std::string name_of_colors = options.colors ? options.colors->name() : "";
    nacre_colors colors{};
    if (options.colors) {
      colors = detail::colors_of(options.colors, name_of_colors);
      asked.colors = &colors;
    }
    asked.standard_texts = options.standard_texts;
    asked.tile_memory = options.tile_memory;
    asked.max_image_size = options.max_image_size;
    asked.max_image_bytes = options.max_image_bytes;
    asked.max_image_file_bytes = options.max_image_file_bytes;
    asked.max_image_channels = options.max_image_channels;
    asked.max_image_layers = options.max_image_layers;
    asked.max_image_expansion = options.max_image_expansion;
    asked.max_image_tiles = options.max_image_tiles;
    nacre_file_resolver resolver{};
    if (options.resolver) asked.resolver = &(resolver = detail::resolver_of(options.resolver));
    nacre_texture_system textures{};
    if (options.textures)
      asked.textures = &(textures = detail::texture_system_of(options.textures));
    nacre_executor executor{};
    if (options.executor) asked.executor = &(executor = detail::executor_of(options.executor));
    nacre_allocator allocator{};
    if (options.memory != nullptr) {
      asked.allocator = &(allocator = detail::allocator_of(options.memory));
    }
    const detail::Said report;
    nacre_system* made = nullptr;
    report.finish(nacre_system_create(&asked, report.get(), &made), said);
    system_.reset(made);
  }

  Shader compile_material(const Document& document, const std::string& material,
                          const CompileOptions& options = {},
                          std::vector<Diagnostic>* said = nullptr) {
    return compile(
        options, said,
        [&](const nacre_compile_options* asked, nacre_report* report, nacre_shader** made) {
          return nacre_compile_material(get(), document.get(), material.c_str(), asked, report,
                                        made);
        });
  }
  /// Several of one material: as compile_material of each, with the same bits, but the graph is
  /// built once and the kernels are made side by side. See nacre_compile_variants.
  std::vector<Shader> compile_variants(const Document& document, const std::string& material,
                                       const std::vector<CompileOptions>& variants,
                                       std::vector<Diagnostic>* said = nullptr) {
    const detail::Said report;
    std::vector<nacre_shader*> made(variants.size());
    std::vector<const nacre_compile_options*> asked;
    with_each(variants, asked, [&] {
      report.finish(nacre_compile_variants(get(), document.get(), material.c_str(), asked.data(),
                                           asked.size(), report.get(), made.data()),
                    said);
    });
    std::vector<Shader> shaders;
    for (nacre_shader* const each : made) shaders.push_back(Shader::adopt(each));
    return shaders;
  }
  Shader compile_outputs(const Document& document, const std::vector<std::string>& outputs,
                         const CompileOptions& options = {},
                         std::vector<Diagnostic>* said = nullptr) {
    const detail::TextList names(outputs);
    return compile(
        options, said,
        [&](const nacre_compile_options* asked, nacre_report* report, nacre_shader** made) {
          return nacre_compile_outputs(get(), document.get(), names.data(), names.size(), asked,
                                       report, made);
        });
  }
  /// All that is wrong with a document, errors too.
  std::vector<Diagnostic> check(const Document& document, const CompileOptions& options = {}) {
    const detail::Said report;
    nacre_status status = NACRE_OK;
    with_options(options, [&](const nacre_compile_options& asked) {
      status = nacre_check(get(), document.get(), &asked, report.get());
    });
    if (status != NACRE_FAILED) detail::check(status);
    return report.all();
  }

  /// Those of the libraries.
  std::vector<NodeDef> nodedefs() const {
    std::vector<NodeDef> list;
    for (std::size_t i = 0; i < nacre_system_nodedef_count(get()); ++i) {
      nacre_nodedef one{};
      one.size = sizeof one;
      detail::check(nacre_system_nodedef(get(), i, &one));
      list.push_back({one.name, one.category, one.group, one.version, one.document,
                      ports(i, one.input_count, nacre_system_input),
                      ports(i, one.output_count, nacre_system_output), one.has_body != 0});
    }
    return list;
  }

  nacre_texture_statistics texture_statistics() const {
    nacre_texture_statistics now{};
    now.size = sizeof now;
    detail::check(nacre_system_texture_statistics(get(), &now));
    return now;
  }
  /// An image in memory in place of a file of that name, replaced in all shaders that have it.
  void set_image(const std::string& name, const Image& image) {
    nacre_image given{};
    given.size = sizeof given;
    given.width = image.width;
    given.height = image.height;
    given.channels = image.channels;
    given.samples = image.samples;
    given.pixels = image.pixels;
    given.row_bytes = image.row_bytes;
    const detail::Said report;
    report.finish(nacre_system_set_image(get(), name.c_str(), &given, report.get()), nullptr);
  }
  /// Shaders that have it keep it.
  void remove_image(const std::string& name) { nacre_system_remove_image(get(), name.c_str()); }
  /// Forgets textures that no shader has.
  void drop_textures() { nacre_system_drop_textures(get()); }

  nacre_system* get() const { return system_.get(); }

 private:
  template <class Get>
  std::vector<Port> ports(std::size_t nodedef, std::size_t count, Get&& port) const {
    std::vector<Port> list;
    for (std::size_t k = 0; k < count; ++k) {
      nacre_port one{};
      one.size = sizeof one;
      detail::check(port(get(), nodedef, k, &one));
      list.push_back({one.name, one.type, one.value, one.geomprop, one.label, one.folder, one.unit,
                      one.document, one.is_uniform != 0});
    }
    return list;
  }

  /// Calls with the options as the C interface takes them.
  template <class Call>
  static void with_options(const CompileOptions& options, Call&& call) {
    const detail::TextList live(options.live);
    const detail::TextList varying(options.varying);
    const detail::TextList with_begin(options.with_begin);
    const detail::TextList paths(options.search_paths);
    nacre_compile_options asked{};
    asked.size = sizeof asked;
    asked.engine = options.engine;
    asked.accuracy = options.accuracy;
    asked.lanes = options.lanes;
    asked.live = live.data();
    asked.live_count = live.size();
    asked.varying = varying.data();
    asked.varying_count = varying.size();
    asked.lobes = options.lobes;
    asked.reverse_pdf = options.reverse_pdf;
    asked.lobe_mask = options.lobe_mask;
    asked.by_lobe = options.by_lobe;
    asked.min_alpha = options.min_alpha;
    asked.entries = options.entries;
    asked.with_begin = with_begin.data();
    asked.with_begin_count = with_begin.size();
    asked.side = options.side;
    asked.background = options.background;
    asked.priority = options.priority;
    asked.max_seconds = options.max_seconds;
    asked.max_anisotropy = options.max_anisotropy;
    asked.no_footprints = options.no_footprints;
    asked.search_paths = paths.data();
    asked.search_path_count = paths.size();
    asked.files_anywhere = options.files_anywhere;
    asked.missing_images_pass = options.missing_images_pass;
    asked.lenient = options.lenient;
    asked.working_space = detail::text_or_null(options.working_space);
    asked.output_space = detail::text_or_null(options.output_space);
    asked.distance_unit = detail::text_or_null(options.distance_unit);
    asked.geometry = detail::text_or_null(options.geometry);
    asked.frame = options.frame.value_or(0);
    asked.has_frame = options.frame.has_value();
    std::vector<nacre_file_name_part> names;
    for (const auto& [name, text] : options.names) names.push_back({name.c_str(), text.c_str()});
    asked.names = names.data();
    asked.name_count = names.size();
    std::vector<nacre_variant> variants;
    for (const Variant& one : options.variants) {
      variants.push_back({one.set.c_str(), one.variant.c_str()});
    }
    asked.variants = variants.data();
    asked.variant_count = variants.size();
    asked.prefer = options.prefer;
    asked.max_nodes = options.max_nodes;
    asked.max_inputs = options.max_inputs;
    asked.max_instructions = options.max_instructions;
    asked.max_steps = options.max_steps;
    asked.stop = options.stop != nullptr ? options.stop->get() : nullptr;
    asked.single_points = options.single_points;
    asked.energy_conserving = options.energy_conserving;
    asked.lobes_wanted = options.lobes_wanted;
    asked.transport = options.transport;
    asked.live_footprints = options.live_footprints;
    asked.fade_noise = options.fade_noise;
    asked.fit_parameters = options.fit_parameters;
    asked.compensation = options.compensation;
    asked.profile = detail::text_or_null(options.profile);
    asked.max_error = options.max_error;
    asked.error_floor = options.error_floor;
    asked.error_is_absolute = options.error_is_absolute;
    asked.error_points = options.error_points;
    asked.error_record = detail::text_or_null(options.error_record);
    asked.measure_error = options.measure_error;
    std::vector<nacre_fact> facts;
    for (const Fact& one : options.facts) {
      facts.push_back({one.name.c_str(), one.minimum, one.maximum});
    }
    asked.facts = facts.data();
    asked.fact_count = facts.size();
    call(asked);
  }

  /// Calls with the options of all that are left, which live as long.
  template <class Call>
  static void with_each(const std::vector<CompileOptions>& variants,
                        std::vector<const nacre_compile_options*>& asked, Call&& call) {
    if (asked.size() == variants.size()) return call();
    with_options(variants[asked.size()], [&](const nacre_compile_options& one) {
      asked.push_back(&one);
      with_each(variants, asked, call);
    });
  }

  template <class Make>
  static Shader compile(const CompileOptions& options, std::vector<Diagnostic>* said, Make&& call) {
    const detail::Said report;
    nacre_shader* made = nullptr;
    with_options(options, [&](const nacre_compile_options& asked) {
      report.finish(call(&asked, report.get(), &made), said);
    });
    return Shader(made);
  }

  detail::Owned<nacre_system, nacre_system_destroy> system_;
};

}  // namespace v0
}  // namespace nacre

#endif
