#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "jit/graph/graph.h"
#include "jit/record/textures.h"
#include "jit/shading/shading_system.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"

namespace nacre {

/// The options of a call that begins now: how long it may take becomes when it must end.
ShaderOptions from_now(const ShaderOptions& options);

/// One graph being made into kernels.
class Compilation {
 public:
  Compilation(const ShaderOptions& options, const Bodies& bodies, SourceBodies& sources,
              TextureStore& store, CompileService* service, Diagnostics& diagnostics);

  std::optional<std::vector<Recorded>> record(const Graph& graph);
  /// What depends on `outputs`.
  Program entry(const char* name, const std::vector<SliceOutput>& outputs, Keeps keeps) const;
  /// All entry points side by side; nothing where the compiler refuses.
  std::vector<std::optional<BoundKernel>> compile(std::vector<Program> programs,
                                                  std::vector<StageReport>& stages);
  /// Every stage of `compile` before machine code, for its diagnostics.
  void try_stages(std::vector<Program> programs);

  /// Whether there is time and room for more; false, with an error, once there is not.
  bool may_go_on();

  Recorder& recorder() { return recorder_; }
  std::size_t image_errors() const { return textures_->error_count(); }

 private:
  /// Who compiles Programs does not know what document they come from.
  void add_located(const Diagnostics& said);

  const ShaderOptions& options_;
  const Bodies& bodies_;
  SourceBodies& sources_;
  CompileService* service_;
  Diagnostics& diagnostics_;
  Recorder recorder_;
  std::shared_ptr<RecordedTextures> textures_;
  SourceLocation where_;  ///< Of what is compiled.
};

/// What compile_outputs makes a kernel of: the channels of every output, in order.
struct RecordedOutputs {
  std::vector<SliceOutput> channels;
  std::vector<OutputKernel::Output> outputs;
};

/// Nothing, with diagnostics, where an output cannot be recorded or has no numbers.
std::optional<RecordedOutputs> record_outputs(Compilation& compilation, const Graph& graph,
                                              const ShaderOptions& options,
                                              Diagnostics& diagnostics);

/// What compile_material makes kernels of: `programs`, each for a place in `kernels`, which
/// has all the rest.
struct RecordedMaterial {
  MaterialKernels kernels;
  std::vector<Program> programs;
  std::vector<std::optional<BoundKernel> MaterialKernels::*> places;
};

/// Nothing, with diagnostics, where a shader cannot be recorded or there is none. `where`
/// the material stands.
std::optional<RecordedMaterial> record_material(Compilation& compilation, const Graph& graph,
                                                const ShaderOptions& options,
                                                const SourceLocation& where,
                                                Diagnostics& diagnostics);

}  // namespace nacre
