#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "jit/api/call.h"
#include "jit/api/compile_options.h"
#include "jit/api/exactness.h"
#include "jit/api/handles.h"
#include "jit/api/share.h"

using namespace nacre;
using namespace nacre::api;

namespace {

template <class Kernels>
nacre_status hand_out(std::unique_ptr<Kernels> kernels, std::shared_ptr<const ShaderError> error,
                      Said& said, nacre_shader** shader) {
  // Kernels that lack an image are there, and not right.
  if (kernels == nullptr || said.has_errors()) return NACRE_FAILED;
  *shader =
      new nacre_shader{std::make_shared<const ShaderData>(std::move(kernels)), std::move(error)};
  return NACRE_OK;
}

}  // namespace

nacre_status nacre_compile_material(nacre_system* system, const nacre_document* document,
                                    const char* material, const nacre_compile_options* options,
                                    nacre_report* report, nacre_shader** shader) {
  if (shader == nullptr) return NACRE_WRONG_ARGUMENTS;
  *shader = nullptr;
  if (system == nullptr || document == nullptr || material == nullptr) {
    return NACRE_WRONG_ARGUMENTS;
  }
  return guarded(report, [&] {
    Said said(report);
    if (!check_compile_options(options, said.diagnostics())) {
      return nacre_status{NACRE_WRONG_ARGUMENTS};
    }
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
      count == 0) {
    return NACRE_WRONG_ARGUMENTS;
  }
  return guarded(report, [&] {
    Said said(report);
    const auto is_meant = [&](const nacre_compile_options* each) {
      return check_compile_options(each, said.diagnostics());
    };
    if (!std::all_of(variants, variants + count, is_meant) ||
        !check_one_graph({variants, count}, said.diagnostics())) {
      return nacre_status{NACRE_WRONG_ARGUMENTS};
    }
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
  if (system == nullptr || document == nullptr || outputs == nullptr || output_count == 0) {
    return NACRE_WRONG_ARGUMENTS;
  }
  return guarded(report, [&] {
    Said said(report);
    if (!check_compile_options(options, said.diagnostics())) {
      return nacre_status{NACRE_WRONG_ARGUMENTS};
    }
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
  if (system == nullptr || document == nullptr) return NACRE_WRONG_ARGUMENTS;
  return guarded(report, [&] {
    Said said(report);
    if (!check_compile_options(options, said.diagnostics())) {
      return nacre_status{NACRE_WRONG_ARGUMENTS};
    }
    system->system->check(*document->document, shader_options(options, *document->document),
                          said.diagnostics());
    return nacre_status{said.has_errors() ? NACRE_FAILED : NACRE_OK};
  });
}

void nacre_shader_destroy(nacre_shader* shader) { delete shader; }

nacre_shader* nacre::api::share(const nacre_shader* shader) { return new nacre_shader(*shader); }
