#include "jit/api/compile_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "jit/api/call.h"
#include "jit/api/handles.h"
#include "jit/graph/look/look.h"

namespace nacre::api {

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
  for (std::size_t i = 0; i < asked.name_count; ++i) {
    options.host_attributes[text_or_empty(asked.names[i].name)] =
        text_or_empty(asked.names[i].text);
  }
  for (std::size_t i = 0; i < asked.variant_count; ++i) {
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

/// Says of options what is not meant.
class Check {
 public:
  explicit Check(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  template <class T>
  void expect(bool is_meant, std::string_view option, std::string_view expected, const T& found) {
    if (is_meant) return;
    is_good_ = false;
    diagnostics_.error("bad-options", {.file = {}, .path = std::string(option)},
                       "an option of the compile has no such value", std::string(expected),
                       fmt::format("{}", found));
  }
  void expect_choice(int value, int choices, std::string_view option) {
    expect(value >= 0 && value < choices, option, fmt::format("0 to {}", choices - 1), value);
  }
  /// A list of so many elements is one.
  void expect_list(const void* list, std::size_t count, std::string_view option) {
    expect(list != nullptr || count == 0, option, "a list, or 0 elements",
           fmt::format("NULL with {} elements", count));
  }
  bool is_good() const { return is_good_; }

 private:
  Diagnostics& diagnostics_;
  bool is_good_ = true;
};

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

}  // namespace

bool check_compile_options(const nacre_compile_options* given, Diagnostics& diagnostics) {
  Check check(diagnostics);
  check.expect(has_size(given), "size", "the size of the structure",
               given != nullptr ? given->size : 0);
  if (!check.is_good()) return false;
  const nacre_compile_options asked = options_of(given);
  check.expect_choice(asked.engine, 3, "engine");
  check.expect_choice(asked.accuracy, 3, "accuracy");
  check.expect_choice(asked.prefer, 3, "prefer");
  check.expect_choice(asked.compensation, 3, "compensation");
  check.expect_choice(asked.side, 2, "side");
  check.expect((asked.lobes & ~lobe_all) == 0, "lobes", "bits of the first four kinds of lobes",
               asked.lobes);
  check.expect((asked.entries >> NACRE_ENTRY_COUNT) == 0, "entries",
               fmt::format("bits 0 to {}", NACRE_ENTRY_COUNT - 1),
               fmt::format("{:#x}", asked.entries));
  check.expect(asked.max_anisotropy >= 0 && asked.max_anisotropy <= 64, "max_anisotropy", "0 to 64",
               asked.max_anisotropy);
  check.expect(asked.max_seconds >= 0, "max_seconds", "0 or more", asked.max_seconds);
  check.expect_list(asked.live, asked.live_count, "live");
  check.expect_list(asked.varying, asked.varying_count, "varying");
  check.expect_list(asked.with_begin, asked.with_begin_count, "with_begin");
  check.expect_list(asked.search_paths, asked.search_path_count, "search_paths");
  check.expect_list(asked.names, asked.name_count, "names");
  check.expect_list(asked.variants, asked.variant_count, "variants");
  check.expect_list(asked.facts, asked.fact_count, "facts");
  // One of a thousand is of a thousand at least.
  const bool has_points =
      asked.error_points == 0 || (asked.error_points >= 1000 && asked.error_points <= 1'000'000);
  check.expect(has_points, "error_points", "1,000 to 1,000,000, or 0", asked.error_points);
  check.expect(std::isfinite(asked.max_error) && asked.max_error >= 0, "max_error",
               "a finite number, 0 or more", asked.max_error);
  check.expect(asked.error_floor >= 0 && asked.error_floor <= 1, "error_floor", "0 to 1",
               asked.error_floor);
  check.expect(asked.max_error == 0 || asked.profile == nullptr, "profile",
               "a profile or max_error", "both");
  return check.is_good();
}

bool check_one_graph(std::span<const nacre_compile_options* const> variants,
                     Diagnostics& diagnostics) {
  const auto one = [&](const nacre_compile_options* each) {
    return make_one_graph(options_of(each), options_of(variants.front()));
  };
  const auto other = std::ranges::find_if_not(variants, one);
  if (other == variants.end()) return true;
  diagnostics.error(
      "bad-options", {}, "options of variants that say what the graph is are not the same",
      "those of variant 0", fmt::format("others of variant {}", other - variants.begin()));
  return false;
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
  for (std::size_t i = 0; i < asked.fact_count; ++i) {
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
  options.fade_noise = asked.fade_noise != 0;
  options.fit_parameters = asked.fit_parameters != 0;
  options.files_anywhere = asked.files_anywhere != 0;
  if (asked.missing_images_pass != 0) options.missing_images = MissingImages::use_default;
  options.graph = graph_options(asked, document);
  return options;
}

}  // namespace nacre::api
