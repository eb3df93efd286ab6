#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jit/document/file_roots.h"
#include "jit/graph/graph.h"
#include "jit/record/textures.h"
#include "jit/shading/system_parts.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"

namespace nacre {

/// The options of a call that begins now: how long it may take becomes when it must end.
ShaderOptions from_now(const ShaderOptions& options);

/// The numbers of a value, as channels "<name>", or "<name>.x" ...
std::vector<SliceOutput> channels_of(const std::string& name, const Recorded& value);

/// The way from a document to kernels, once: graph, record, slice, passes, machine code.
/// make_outputs and make_material read as that way; check goes it up to machine code.
class Compilation {
 public:
  Compilation(const SystemParts& parts, ShaderOptions options, Diagnostics& diagnostics);

  /// The document of graphs that others have built.
  void is_of(const Document& document) { document_ = &document; }
  /// Stage "graph": nodedefs resolved, node graphs inlined.
  std::optional<Graph> build(const Document& document, const GraphRequest& request);

  /// Nothing, after an error, for what leads to no kernel. `where` the material stands.
  std::unique_ptr<OutputKernel> make_outputs(const Graph& graph);
  std::unique_ptr<MaterialKernels> make_material(const Graph& graph, const SourceLocation& where);

  /// What compile_outputs makes a kernel of: the channels of every output, in order.
  struct RecordedOutputs {
    std::vector<OutputKernel::Output> outputs;
    std::vector<Program> programs;  ///< One, sliced.
  };
  /// What compile_material makes kernels of: `programs`, each for a place in `kernels`, which
  /// has all the rest.
  struct RecordedMaterial {
    MaterialKernels kernels;
    std::vector<Program> programs;
    std::vector<std::optional<BoundKernel> MaterialKernels::*> places;
  };
  // Stages "record" and "slice": nothing, with diagnostics, where an output cannot be
  // recorded or has no numbers, or there is no shader.
  std::optional<std::vector<Recorded>> record(const Graph& graph);
  std::optional<RecordedOutputs> record_outputs(const Graph& graph);
  std::optional<RecordedMaterial> record_material(const Graph& graph, const SourceLocation& where);

  /// The rest of make_material, by any thread: null, after an error, where there is no kernel.
  std::unique_ptr<MaterialKernels> finish(const Graph& graph, RecordedMaterial recorded);

  /// The passes, for their diagnostics.
  void try_stages(std::vector<Program> programs);

 private:
  /// The passes and machine code, all entry points side by side; nothing where the compiler
  /// refuses.
  std::vector<std::optional<BoundKernel>> compile(std::vector<Program> programs);
  /// Nothing for a null surface; not complete where one of its lobes could not be recorded.
  SurfaceKernels record_surface(const SurfacePtr& surface);
  /// What KernelRequest::with_begin names, each once; an error for what there is not.
  std::vector<SliceOutput> point_results(const Graph& graph, const std::vector<Recorded>& values,
                                         const SurfaceKernels& kernels,
                                         const SourceLocation& where);
  RecordOptions record_options(const FileRoots& roots);
  /// What the textures know an image by: the host's name for it, or a path.
  std::string resolve_image(const std::string& name, const std::string& document,
                            const FileRoots& roots);
  std::vector<Parameter> live_parameters(const Graph& graph) const;
  /// Whether a slot comes with each point.
  bool varies(std::string_view slot) const;
  /// Says of patterns that they are of nothing.
  void warn_of_unfit(const Graph& graph, const RecordOptions& options);
  /// Whether nothing was wrong since there were so many errors, but for images that are missing.
  bool is_complete(std::size_t errors_before) const;
  /// Whether there is time and room for more; false, with an error, once there is not.
  bool may_go_on();
  /// What facts have left out of a kernel that they concern, by its reports.
  void add_uses(const std::vector<StageReport>& reports);
  /// Who compiles Programs does not know what document they come from.
  void add_located(const Diagnostics& said);

  const SystemParts& parts_;
  const ShaderOptions options_;
  Diagnostics& diagnostics_;
  Recorder recorder_;
  std::shared_ptr<RecordedTextures> textures_;
  SourceLocation where_;  ///< Of what is compiled.
  std::vector<StageReport> stages_;
  std::vector<FactUse> facts_;          ///< Of all kernels.
  std::vector<Fact> unfound_facts_;     ///< Those of no node of the document.
  const Document* document_ = nullptr;  ///< What the graph is of; null: nobody knows.
  std::size_t errors_before_;           ///< What was wrong before there was anything to compile.
};

}  // namespace nacre
