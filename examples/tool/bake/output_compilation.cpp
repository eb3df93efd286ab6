#include "examples/tool/bake/output_compilation.h"

#include <algorithm>
#include <utility>

#include "jit/graph/build/build.h"

namespace nacre::tool {

namespace {

/// An image that several outputs read and that is broken is one fault.
void add_new(const Diagnostics& said, Diagnostics& diagnostics) {
  for (const Diagnostic& one : said.all()) {
    const bool is_known = std::ranges::any_of(
        diagnostics.all(),
        [text = one.to_string()](const Diagnostic& known) { return known.to_string() == text; });
    if (!is_known) diagnostics.add(one);
  }
}

}  // namespace

OutputCompilation::OutputCompilation(const Opened& opened, const std::string& output,
                                     const ShaderOptions& shader)
    : shader_(reproducible(with_profile(opened, output, false, shader, said_))) {
  shader_.compile.stop = stop_from_now(shader_.compile);
  // Either way: where there is no thread to be had, whoever waits does it.
  made_ = std::async(std::launch::async | std::launch::deferred,
                     [this, &opened, output] { return make(opened, output); });
}

OutputCompilation::Made OutputCompilation::make(const Opened& opened,
                                                const std::string& output) const {
  Made made;
  made.result.graph =
      build_graph(*opened.document, opened.system->library(), {.outputs = {output}, .material = {}},
                  opened.system->graph_options(shader_), made.said);
  if (made.result.graph) {
    made.result.kernel = opened.system->compile_outputs(*made.result.graph, shader_, made.said);
  }
  return made;
}

OutputCompilation::Result OutputCompilation::finish(Diagnostics& diagnostics) {
  Made made = made_.get();
  add_new(said_, diagnostics);
  add_new(made.said, diagnostics);
  return std::move(made.result);
}

}  // namespace nacre::tool
