/// \file
/// What documents share, and compiling them: part of <nacre/nacre.hpp>.
#ifndef NACRE_SYSTEM_HPP
#define NACRE_SYSTEM_HPP

#include <cstdint>
#include <exception>
#include <nacre/document.hpp>
#include <nacre/record.hpp>
#include <nacre/shader.hpp>
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
  std::vector<Body> bodies = {};  ///< Nodedefs that the host implements.
};

/// How a shader is compiled; see nacre_compile_options.
struct CompileOptions {
  int engine = NACRE_JIT;
  int accuracy = NACRE_STANDARD;
  int lanes = 0;
  std::vector<std::string> live;     ///< Patterns of what may change: "SR_gold/*".
  std::vector<std::string> varying;  ///< Patterns of those that come with each point.
  int lobes = 0;
  bool reverse_pdf = false;
  bool lobe_mask = false;
  bool by_lobe = false;
  bool min_alpha = false;
  std::uint32_t entries = 0;            ///< Bits 1 << nacre_entry.
  std::vector<std::string> with_begin;  ///< "albedo", "normal", "SR_gold/base_color".
  int side = NACRE_FRONT;
  bool background = false;
  double max_seconds = 0;
  int max_anisotropy = 0;
  bool no_footprints = false;
  std::vector<std::string> search_paths;
  bool files_anywhere = false;
  bool missing_images_pass = false;
  bool lenient = false;
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
  nacre_system* get() const { return system_.get(); }

 private:
  template <class Make>
  static Shader compile(const CompileOptions& options, std::vector<Diagnostic>* said, Make&& call) {
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
    asked.max_seconds = options.max_seconds;
    asked.max_anisotropy = options.max_anisotropy;
    asked.no_footprints = options.no_footprints;
    asked.search_paths = paths.data();
    asked.search_path_count = paths.size();
    asked.files_anywhere = options.files_anywhere;
    asked.missing_images_pass = options.missing_images_pass;
    asked.lenient = options.lenient;
    const detail::Said report;
    nacre_shader* made = nullptr;
    report.finish(call(&asked, report.get(), &made), said);
    return Shader(made);
  }

  detail::Owned<nacre_system, nacre_system_destroy> system_;
};

}  // namespace v0
}  // namespace nacre

#endif
