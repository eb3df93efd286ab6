// Compiled kernels, and what they say of themselves.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <utility>

#include "jit/api/python/errors.h"
#include "jit/api/python/module.h"

namespace nacre::python {

namespace nb = nanobind;

namespace {

template <class Make>
void construct(Shader* self, Make&& make) {
  std::vector<Diagnostic> said;
  Shader made = [&] {
    const nb::gil_scoped_release others_run;
    return make(&said);
  }();
  warn(said);
  new (self) Shader(std::move(made));
}

/// Tuples (name, component, type, role, unit, meaning).
nb::list as_python(const std::vector<Channel>& channels) {
  nb::list list;
  for (const Channel& each : channels) {
    list.append(nb::make_tuple(text(each.name), each.component, each.type, each.role,
                               text(each.unit), text(each.meaning)));
  }
  return list;
}

/// `components` four-byte numbers; none of them where there is no limit.
nb::object numbers(const void* from, int components) {
  if (from == nullptr) return nb::none();
  return nb::bytes(from, 4 * static_cast<std::size_t>(components));
}

/// Tuples (name, type, number_type, components, is_varying, value, minimum, maximum, label,
/// folder, unit, doc), the three values as bytes.
nb::list parameters_of(const Shader& shader) {
  nb::list list;
  for (std::size_t i = 0; i < nacre_shader_parameter_count(shader.get()); ++i) {
    nacre_parameter one{};
    one.size = sizeof one;
    detail::check(nacre_shader_parameter(shader.get(), i, &one));
    list.append(nb::make_tuple(text(one.name), text(one.type), one.number_type, one.components,
                               one.is_varying != 0, numbers(one.value, one.components),
                               numbers(one.minimum, one.components),
                               numbers(one.maximum, one.components), text(one.label),
                               text(one.folder), text(one.unit), text(one.document)));
  }
  return list;
}

}  // namespace

void bind_shader(nb::module_& module) {
  nb::enum_<nacre_entry>(module, "Entry", nb::is_arithmetic(),
                         "What is asked of a shader. OUTPUTS is of graphs, the others are of "
                         "materials.")
      .value("OUTPUTS", NACRE_OUTPUTS, "Values of graphs.")
      .value("BEGIN", NACRE_BEGIN, "What depends on the point alone, kept as the state.")
      .value("SAMPLE", NACRE_SAMPLE, "State and u: a direction wi, its weight, pdf, lobe, flags.")
      .value("EVALUATE", NACRE_EVALUATE, "State and wi: f, pdf.")
      .value("EVALUATE_AT", NACRE_EVALUATE_AT, "The same for one point and many wi.")
      .value("ALBEDO", NACRE_ALBEDO, "The share of light from wo that scatters.")
      .value("EMISSION", NACRE_EMISSION, "Radiance towards wo.")
      .value("OPACITY", NACRE_OPACITY, "Presence of the surface, and what passes straight on.")
      .value("DISPLACEMENT", NACRE_DISPLACEMENT, "An offset.")
      .value("VOLUME", NACRE_VOLUME, "A medium's absorption, scattering, anisotropy, emission.")
      .value("LIGHT", NACRE_LIGHT, "Intensity and direction of a light.")
      .value("SHADE", NACRE_SHADE, "Point, wi and u at once, without a state.")
      .value("INTERIOR", NACRE_INTERIOR, "Index and medium of what the surface encloses.")
      .value("SUBSURFACE", NACRE_SUBSURFACE, "Medium of light that goes below the surface.")
      .value("SHADOW", NACRE_SHADOW, "Presence, and what is held back of light straight on.")
      .value("EMIT", NACRE_EMIT, "A direction that light leaves along, its weight and pdf.");

  nb::class_<Shader>(module, "Shader")
      .def(
          "__init__",
          [](Shader* self, System& system, const Document& document, const std::string& material,
             const CompileOptions& options) {
            construct(self, [&](auto* said) {
              return system.compile_material(document, material, options, said);
            });
          },
          nb::arg("system"), nb::arg("document"), nb::arg("material"), nb::arg("options"))
      .def(
          "__init__",
          [](Shader* self, System& system, const Document& document,
             const std::vector<std::string>& outputs, const CompileOptions& options) {
            construct(self, [&](auto* said) {
              return system.compile_outputs(document, outputs, options, said);
            });
          },
          nb::arg("system"), nb::arg("document"), nb::arg("outputs"), nb::arg("options"))
      .def(
          "__init__", [](Shader* self, Shader& made) { new (self) Shader(std::move(made)); },
          nb::arg("made"), "Takes what System._compile_variants has made.")
      .def("has", &Shader::has, nb::arg("entry"),
           "Whether there is something to compute: a material that does not emit has no EMISSION.")
      .def_prop_ro("state_count", &Shader::state_count,
                   "Numbers a point that BEGIN stores for other entries.")
      .def_prop_ro("has_back", &Shader::has_back,
                   "Whether the back shows another shader, to be compiled with side='back'.")
      .def_prop_ro(
          "left_out", [](const Shader& self) { return texts(self.left_out()); },
          nb::sig("def left_out(self) -> list[str]"), "What the kernels leave out, a line each.")
      .def("_facts",
           [](const Shader& self) {
             nb::list list;
             for (const FactInfo& each : self.facts()) {
               list.append(nb::make_tuple(
                   text(each.fact.name), each.fact.minimum, each.fact.maximum,
                   each.saved ? nb::object(nb::int_(*each.saved)) : nb::object(nb::none())));
             }
             return list;
           })
      .def_prop_ro("points_outside_facts", &Shader::points_outside_facts,
                   "Points so far that were computed as if facts had not been stated, since they "
                   "were not true of one of them.")
      .def("_error",
           [](const Shader& self) -> nb::object {
             const std::optional<ShaderError> e = self.error();
             if (!e) return nb::none();
             return nb::make_tuple(e->mean, e->p999, e->maximum, text(e->worst), e->floor,
                                   e->is_absolute, text(e->points));
           })
      .def_prop_ro(
          "profile",
          [](const Shader& self) -> nb::object {
            const std::string chosen = self.profile();
            return chosen.empty() ? nb::none() : nb::object(text(chosen));
          },
          nb::sig("def profile(self) -> str | None"),
          "What max_error has chosen, for the option profile; None where it was not asked for.")
      .def_prop_ro("is_pending", &Shader::is_pending,
                   "Whether code is being made in the background, and kernels are interpreted.")
      .def("wait", &Shader::wait, nb::call_guard<nb::gil_scoped_release>(),
           "Waits until nothing is pending. Error where an entry stays interpreted.")
      .def(
          "_inputs",
          [](const Shader& self, nacre_entry entry) { return as_python(self.inputs(entry)); },
          nb::arg("entry"))
      .def(
          "_results",
          [](const Shader& self, nacre_entry entry) { return as_python(self.results(entry)); },
          nb::arg("entry"))
      .def("_lobes",
           [](const Shader& self) {
             nb::list list;
             for (const LobeInfo& each : self.lobes()) {
               list.append(nb::make_tuple(text(each.name), text(each.path), each.kinds));
             }
             return list;
           })
      .def("_parameters", parameters_of);
}

}  // namespace nacre::python
