#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <vector>

#include "jit/api/call.h"
#include "jit/api/exactness.h"
#include "jit/api/handles.h"
#include "jit/api/share.h"
#include "jit/graph/look/look.h"

using namespace nacre;
using namespace nacre::api;

namespace {

static_assert(entry_begin == 1u << NACRE_BEGIN && entry_evaluate_at == 1u << NACRE_EVALUATE_AT &&
              entry_opacity == 1u << NACRE_OPACITY && entry_shade == 1u << NACRE_SHADE &&
              entry_interior == 1u << NACRE_INTERIOR &&
              entry_subsurface == 1u << NACRE_SUBSURFACE && entry_shadow == 1u << NACRE_SHADOW &&
              entry_emit == 1u << NACRE_EMIT);
static_assert(int{lobe_all} == (NACRE_DIFFUSE_REFLECTION | NACRE_GLOSSY_REFLECTION |
                                NACRE_DIFFUSE_TRANSMISSION | NACRE_GLOSSY_TRANSMISSION) &&
              int{lobe_delta_reflection} == NACRE_DELTA_REFLECTION &&
              int{lobe_delta_transmission} == NACRE_DELTA_TRANSMISSION);

GraphOptions graph_options(const nacre_compile_options& asked, const Document& document) {
  constexpr std::array preferences{Preference::body, Preference::graph, Preference::source};
  GraphOptions options;
  options.lenient = asked.lenient != 0;
  if (asked.working_space != nullptr) options.working_space = asked.working_space;
  options.output_space = text_or_empty(asked.output_space);
  if (asked.distance_unit != nullptr) options.distance_unit = asked.distance_unit;
  if (asked.has_frame != 0) options.frame = asked.frame;
  options.prefer = preferences.at(static_cast<std::size_t>(asked.prefer));
  for (std::size_t i = 0; asked.names != nullptr && i < asked.name_count; ++i) {
    options.host_attributes[text_or_empty(asked.names[i].name)] =
        text_or_empty(asked.names[i].text);
  }
  for (std::size_t i = 0; asked.variants != nullptr && i < asked.variant_count; ++i) {
    options.variants.push_back(
        {text_or_empty(asked.variants[i].set), text_or_empty(asked.variants[i].variant)});
  }
  if (asked.max_nodes != 0) options.max_nodes = asked.max_nodes;
  if (asked.max_inputs != 0) options.max_inputs = asked.max_inputs;
  if (asked.geometry != nullptr) {
    Diagnostics of_the_document;  // nacre_check says them.
    options.geometry_tokens = GeometryRules(document, of_the_document).tokens_of(asked.geometry);
  }
  return options;
}

ShaderOptions shader_options(const nacre_compile_options* given, const Document& document) {
  const nacre_compile_options asked = options_of(given);
  ShaderOptions options;
  constexpr std::array backends{Backend::jit, Backend::interpreter, Backend::reference};
  constexpr std::array accuracies{Accuracy::standard, Accuracy::precise, Accuracy::fast};
  options.compile.backend = backends.at(static_cast<std::size_t>(asked.engine));
  options.compile.accuracy = accuracies.at(static_cast<std::size_t>(asked.accuracy));
  options.compile.lanes = asked.lanes;
  options.compile.single_points = asked.single_points != 0;
  options.compile.asynchronous = asked.background != 0;
  options.compile.priority = asked.priority;
  options.compile.stop = stop_of(asked.stop);
  if (asked.max_instructions != 0) options.compile.max_instructions = asked.max_instructions;
  if (asked.max_steps != 0) options.compile.max_steps = asked.max_steps;
  if (asked.max_seconds > 0) options.compile.max_seconds = asked.max_seconds;
  for (std::size_t i = 0; asked.facts != nullptr && i < asked.fact_count; ++i) {
    const nacre_fact& fact = asked.facts[i];
    options.compile.facts.push_back({text_or_empty(fact.name), fact.minimum, fact.maximum});
  }
  options.live = texts_of(asked.live, asked.live_count);
  options.varying = texts_of(asked.varying, asked.varying_count);
  if (asked.lobes != 0) options.kernels.lobes = asked.lobes;
  options.kernels.reverse_pdf = asked.reverse_pdf != 0;
  options.kernels.lobe_mask = asked.lobe_mask != 0;
  options.kernels.by_lobe = asked.by_lobe != 0;
  options.kernels.min_alpha = asked.min_alpha != 0;
  options.kernels.lobes_wanted = asked.lobes_wanted != 0;
  options.kernels.transport = asked.transport != 0;
  options.kernels.energy_conserving = asked.energy_conserving != 0;
  options.kernels.compensation = static_cast<Compensation>(asked.compensation);
  if (asked.entries != 0) options.kernels.entries = asked.entries;
  options.kernels.with_begin = texts_of(asked.with_begin, asked.with_begin_count);
  options.side = asked.side == NACRE_BACK ? Side::back : Side::front;
  if (asked.max_anisotropy != 0) options.max_anisotropy = asked.max_anisotropy;
  for (const std::string& path : texts_of(asked.search_paths, asked.search_path_count)) {
    options.search_paths.emplace_back(path);
  }
  options.footprints = asked.no_footprints == 0;
  options.live_footprints = asked.live_footprints != 0;
  options.files_anywhere = asked.files_anywhere != 0;
  if (asked.missing_images_pass != 0) options.missing_images = MissingImages::use_default;
  options.graph = graph_options(asked, document);
  return options;
}

template <class Kernels>
nacre_status hand_out(std::unique_ptr<Kernels> kernels, std::shared_ptr<const ShaderError> error,
                      Said& said, nacre_shader** shader) {
  // Kernels that lack an image are there, and not right.
  if (kernels == nullptr || said.has_errors()) return NACRE_FAILED;
  *shader =
      new nacre_shader{std::make_shared<const ShaderData>(std::move(kernels)), std::move(error)};
  return NACRE_OK;
}

bool is_meant(const nacre_compile_options* given) {
  if (!has_size(given)) return false;
  const nacre_compile_options asked = options_of(given);
  const auto is_one_of_three = [](int value) { return value >= 0 && value <= 2; };
  return is_one_of_three(asked.engine) && is_one_of_three(asked.accuracy) &&
         is_one_of_three(asked.prefer) && is_one_of_three(asked.compensation) &&
         is_exactness_meant(asked);
}

bool is_same(const char* a, const char* b) {
  return std::strcmp(text_or_empty(a), text_or_empty(b)) == 0;
}

/// Whether two options lead from a document to the same graph.
bool make_one_graph(const nacre_compile_options& a, const nacre_compile_options& b) {
  const auto are_same = [](const auto* some, std::size_t count, const auto* others,
                           std::size_t other_count, auto&& is_pair) {
    if (some == nullptr || others == nullptr) return some == others || count + other_count == 0;
    return std::equal(some, some + count, others, others + other_count, is_pair);
  };
  const bool has_same_names = are_same(
      a.names, a.name_count, b.names, b.name_count, [](const auto& one, const auto& other) {
        return is_same(one.name, other.name) && is_same(one.text, other.text);
      });
  const bool has_same_variants =
      are_same(a.variants, a.variant_count, b.variants, b.variant_count,
               [](const auto& one, const auto& other) {
                 return is_same(one.set, other.set) && is_same(one.variant, other.variant);
               });
  return has_same_names && has_same_variants && is_same(a.working_space, b.working_space) &&
         is_same(a.output_space, b.output_space) && is_same(a.distance_unit, b.distance_unit) &&
         is_same(a.geometry, b.geometry) && a.lenient == b.lenient && a.prefer == b.prefer &&
         a.has_frame == b.has_frame && a.frame == b.frame && a.max_nodes == b.max_nodes &&
         a.max_inputs == b.max_inputs;
}

bool are_meant(const nacre_compile_options* const* variants, std::size_t count) {
  return std::all_of(variants, variants + count, [&](const nacre_compile_options* each) {
    return is_meant(each) && make_one_graph(options_of(each), options_of(variants[0]));
  });
}

}  // namespace

nacre_status nacre_compile_material(nacre_system* system, const nacre_document* document,
                                    const char* material, const nacre_compile_options* options,
                                    nacre_report* report, nacre_shader** shader) {
  if (shader == nullptr) return NACRE_WRONG_ARGUMENTS;
  *shader = nullptr;
  if (system == nullptr || document == nullptr || material == nullptr || !is_meant(options)) {
    return NACRE_WRONG_ARGUMENTS;
  }
  return guarded(report, [&] {
    Said said(report);
    const Document& from = *document->document;
    ShaderOptions asked = shader_options(options, from);
    std::shared_ptr<const ShaderError> error;
    const TuneSubject subject{system->system.get(), &from, {material}, true};
    if (!choose_exactness(options_of(options), subject, asked, error, said.diagnostics())) {
      return nacre_status{NACRE_FAILED};
    }
    return hand_out(system->system->compile_material(from, material, asked, said.diagnostics()),
                    std::move(error), said, shader);
  });
}

nacre_status nacre_compile_variants(nacre_system* system, const nacre_document* document,
                                    const char* material,
                                    const nacre_compile_options* const* variants, size_t count,
                                    nacre_report* report, nacre_shader** shaders) {
  if (shaders == nullptr) return NACRE_WRONG_ARGUMENTS;
  std::fill_n(shaders, count, nullptr);
  if (system == nullptr || document == nullptr || material == nullptr || variants == nullptr ||
      count == 0 || !are_meant(variants, count)) {
    return NACRE_WRONG_ARGUMENTS;
  }
  return guarded(report, [&] {
    Said said(report);
    const Document& from = *document->document;
    const TuneSubject subject{system->system.get(), &from, {material}, true};
    std::vector<ShaderOptions> asked;
    std::vector<std::shared_ptr<const ShaderError>> errors(count);
    for (std::size_t i = 0; i < count; ++i) {
      asked.push_back(shader_options(variants[i], from));
      if (!choose_exactness(options_of(variants[i]), subject, asked[i], errors[i],
                            said.diagnostics())) {
        return nacre_status{NACRE_FAILED};
      }
    }
    auto made = system->system->compile_variants(from, material, asked, said.diagnostics());
    if (made.empty() || said.has_errors()) return nacre_status{NACRE_FAILED};
    std::vector<std::unique_ptr<nacre_shader>> handles;
    for (std::size_t i = 0; i < count; ++i) {
      handles.push_back(std::make_unique<nacre_shader>(nacre_shader{
          std::make_shared<const ShaderData>(std::move(made[i])), std::move(errors[i])}));
    }
    for (std::size_t i = 0; i < count; ++i) shaders[i] = handles[i].release();
    return nacre_status{NACRE_OK};
  });
}

nacre_status nacre_compile_outputs(nacre_system* system, const nacre_document* document,
                                   const char* const* outputs, size_t output_count,
                                   const nacre_compile_options* options, nacre_report* report,
                                   nacre_shader** shader) {
  if (shader == nullptr) return NACRE_WRONG_ARGUMENTS;
  *shader = nullptr;
  if (system == nullptr || document == nullptr || outputs == nullptr || output_count == 0 ||
      !is_meant(options)) {
    return NACRE_WRONG_ARGUMENTS;
  }
  return guarded(report, [&] {
    Said said(report);
    const Document& from = *document->document;
    const std::vector<std::string> names = texts_of(outputs, output_count);
    ShaderOptions asked = shader_options(options, from);
    std::shared_ptr<const ShaderError> error;
    const TuneSubject subject{system->system.get(), &from, names, false};
    if (!choose_exactness(options_of(options), subject, asked, error, said.diagnostics())) {
      return nacre_status{NACRE_FAILED};
    }
    return hand_out(system->system->compile_outputs(from, names, asked, said.diagnostics()),
                    std::move(error), said, shader);
  });
}

nacre_status nacre_check(nacre_system* system, const nacre_document* document,
                         const nacre_compile_options* options, nacre_report* report) {
  if (system == nullptr || document == nullptr || !is_meant(options)) return NACRE_WRONG_ARGUMENTS;
  return guarded(report, [&] {
    Said said(report);
    system->system->check(*document->document, shader_options(options, *document->document),
                          said.diagnostics());
    return nacre_status{said.has_errors() ? NACRE_FAILED : NACRE_OK};
  });
}

void nacre_shader_destroy(nacre_shader* shader) { delete shader; }

nacre_shader* nacre::api::share(const nacre_shader* shader) { return new nacre_shader(*shader); }
