// MaterialX documents.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <utility>

#include "jit/api/python/errors.h"
#include "jit/api/python/module.h"
#include "jit/api/python/resolver.h"

namespace nacre::python {

namespace nb = nanobind;

namespace {

/// Makes a document without the GIL, then says what there is to say.
template <class Make>
void construct(Document* self, Make&& make) {
  std::vector<Diagnostic> said;
  Document made = [&] {
    const nb::gil_scoped_release others_run;
    return make(&said);
  }();
  warn(said);
  new (self) Document(std::move(made));
}

ReadOptions read_options(std::vector<std::string> search_paths, bool includes_anywhere,
                         const nb::object& resolver) {
  ReadOptions options;
  options.search_paths = std::move(search_paths);
  options.includes_anywhere = includes_anywhere;
  options.resolver = resolver_of(resolver);
  return options;
}

}  // namespace

void bind_document(nb::module_& module) {
  nb::class_<Document>(module, "Document")
      .def(
          "__init__",
          [](Document* self, const std::string& file, std::vector<std::string> search_paths,
             bool includes_anywhere, const nb::object& resolver) {
            const ReadOptions options =
                read_options(std::move(search_paths), includes_anywhere, resolver);
            construct(self, [&](auto* said) { return Document::read(file, options, said); });
          },
          nb::arg("file"), nb::arg("search_paths"), nb::arg("includes_anywhere"),
          nb::arg("resolver").none())
      .def(
          "__init__",
          [](Document* self, const std::string& text, const std::string& name,
             std::vector<std::string> search_paths, bool includes_anywhere,
             const nb::object& resolver) {
            const ReadOptions options =
                read_options(std::move(search_paths), includes_anywhere, resolver);
            construct(self, [&](auto* said) { return Document::parse(text, name, options, said); });
          },
          nb::arg("text"), nb::arg("name"), nb::arg("search_paths"), nb::arg("includes_anywhere"),
          nb::arg("resolver").none())
      .def_prop_ro(
          "materials", [](const Document& self) { return texts(self.materials()); },
          nb::sig("def materials(self) -> list[str]"),
          "Names of the document's material nodes, in its order.")
      .def_prop_ro(
          "outputs", [](const Document& self) { return texts(self.outputs()); },
          nb::sig("def outputs(self) -> list[str]"),
          "Outputs of the document and its node graphs that can be computed: 'NG_marble/out'.");
}

}  // namespace nacre::python
