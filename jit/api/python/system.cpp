// What documents share, and how shaders are compiled.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>
#include <utility>

#include "jit/api/python/errors.h"
#include "jit/api/python/image_view.h"
#include "jit/api/python/module.h"
#include "jit/api/python/resolver.h"

namespace nacre::python {

namespace nb = nanobind;

/// Name, least and greatest.
using StatedFact = std::tuple<std::string, double, double>;

void bind_system(nb::module_& module) {
  nb::class_<System>(module, "System")
      .def(
          "__init__",
          [](System* self, std::vector<std::string> libraries, std::string ocio_config,
             std::string cache, int compile_threads, bool compile_apart,
             std::uint64_t texture_memory, const nb::object& resolver) {
            SystemOptions options;
            options.libraries = std::move(libraries);
            options.ocio_config = std::move(ocio_config);
            options.cache = std::move(cache);
            options.compile_threads = compile_threads;
            options.compile_apart = compile_apart;
            options.texture_memory = texture_memory;
            options.resolver = resolver_of(resolver);
            std::vector<Diagnostic> said;
            System made = [&] {
              const nb::gil_scoped_release others_run;
              return System(options, &said);
            }();
            warn(said);
            new (self) System(std::move(made));
          },
          nb::arg("libraries"), nb::arg("ocio_config"), nb::arg("cache"),
          nb::arg("compile_threads"), nb::arg("compile_apart"), nb::arg("texture_memory"),
          nb::arg("resolver").none())
      .def(
          "_compile_variants",
          [](System& self, const Document& document, const std::string& material,
             const std::vector<CompileOptions>& variants) {
            std::vector<Diagnostic> said;
            std::vector<Shader> made = [&] {
              const nb::gil_scoped_release others_run;
              return self.compile_variants(document, material, variants, &said);
            }();
            warn(said);
            nb::list shaders;
            for (Shader& each : made) shaders.append(nb::cast(std::move(each)));
            return shaders;
          },
          nb::arg("document"), nb::arg("material"), nb::arg("variants"),
          nb::sig("def _compile_variants(self, document: Document, material: str, "
                  "variants: list[CompileOptions]) -> list"))
      .def(
          "_check",
          [](System& self, const Document& document, const CompileOptions& options) {
            const std::vector<Diagnostic> said = [&] {
              const nb::gil_scoped_release others_run;
              return self.check(document, options);
            }();
            return diagnostics_of(said);
          },
          nb::arg("document"), nb::arg("options"),
          nb::sig("def _check(self, document: Document, options: CompileOptions) -> list"))
      .def(
          "set_image",
          [](System& self, const std::string& name, nb::handle pixels) {
            const ImageView view(pixels, name);
            const nb::gil_scoped_release others_run;
            self.set_image(name, view.image());
          },
          nb::arg("name"), nb::arg("pixels"),
          nb::sig("def set_image(self, name: str, pixels: object) -> None"),
          "An image in memory in place of a file of that name, replaced in all shaders that have "
          "it.\n\npixels  (height, width) or (height, width, channels), row 0 on top, of uint8, "
          "uint16, float16 or float32; copied")
      .def("remove_image", &System::remove_image, nb::arg("name"),
           "Forgets an image of set_image(); shaders that have it keep it.")
      .def("drop_textures", &System::drop_textures, "Forgets textures that no shader has.");

  nb::class_<CompileOptions>(module, "CompileOptions")
      .def(nb::init<>())
      .def_rw("engine", &CompileOptions::engine)
      .def_rw("accuracy", &CompileOptions::accuracy)
      .def_rw("lanes", &CompileOptions::lanes)
      .def_rw("live", &CompileOptions::live)
      .def_rw("varying", &CompileOptions::varying)
      .def_rw("lobes", &CompileOptions::lobes)
      .def_rw("reverse_pdf", &CompileOptions::reverse_pdf)
      .def_rw("lobe_mask", &CompileOptions::lobe_mask)
      .def_rw("by_lobe", &CompileOptions::by_lobe)
      .def_rw("lobes_wanted", &CompileOptions::lobes_wanted)
      .def_rw("transport", &CompileOptions::transport)
      .def_rw("min_alpha", &CompileOptions::min_alpha)
      .def_rw("energy_conserving", &CompileOptions::energy_conserving)
      .def_rw("entries", &CompileOptions::entries)
      .def_rw("with_begin", &CompileOptions::with_begin)
      .def_rw("side", &CompileOptions::side)
      .def_rw("background", &CompileOptions::background)
      .def_rw("max_seconds", &CompileOptions::max_seconds)
      .def_rw("max_anisotropy", &CompileOptions::max_anisotropy)
      .def_rw("no_footprints", &CompileOptions::no_footprints)
      .def_rw("live_footprints", &CompileOptions::live_footprints)
      .def_rw("fade_noise", &CompileOptions::fade_noise)
      .def_rw("fit_parameters", &CompileOptions::fit_parameters)
      .def_rw("compensation", &CompileOptions::compensation)
      .def_rw("profile", &CompileOptions::profile)
      .def_rw("max_error", &CompileOptions::max_error)
      .def_rw("error_floor", &CompileOptions::error_floor)
      .def_rw("error_is_absolute", &CompileOptions::error_is_absolute)
      .def_rw("error_points", &CompileOptions::error_points)
      .def_rw("error_record", &CompileOptions::error_record)
      .def_rw("measure_error", &CompileOptions::measure_error)
      .def_prop_rw(
          "facts",
          [](const CompileOptions& self) {
            std::vector<StatedFact> facts;
            for (const Fact& each : self.facts) {
              facts.emplace_back(each.name, each.minimum, each.maximum);
            }
            return facts;
          },
          [](CompileOptions& self, const std::vector<StatedFact>& facts) {
            self.facts.clear();
            for (const auto& [name, minimum, maximum] : facts) {
              self.facts.push_back({name, minimum, maximum});
            }
          })
      .def_rw("search_paths", &CompileOptions::search_paths)
      .def_rw("files_anywhere", &CompileOptions::files_anywhere)
      .def_rw("missing_images_pass", &CompileOptions::missing_images_pass)
      .def_rw("lenient", &CompileOptions::lenient)
      .def_rw("working_space", &CompileOptions::working_space)
      .def_rw("output_space", &CompileOptions::output_space)
      .def_rw("distance_unit", &CompileOptions::distance_unit)
      .def_rw("geometry", &CompileOptions::geometry)
      .def_rw("frame", &CompileOptions::frame)
      .def_rw("max_nodes", &CompileOptions::max_nodes)
      .def_rw("max_instructions", &CompileOptions::max_instructions);
}

}  // namespace nacre::python
