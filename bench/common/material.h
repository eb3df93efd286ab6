#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "jit/compile/compile.h"
#include "jit/graph/build/build.h"
#include "jit/graph/graph.h"
#include "jit/record/bodies.h"
#include "jit/record/record.h"
#include "jit/record/textures.h"
#include "jit/tune/kernel_run.h"
#include "pbs/kernels.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"

namespace nacre::bench {

enum class Entry { begin, sample, evaluate, albedo };
const char* entry_name(Entry entry);

/// The bodies that the data library's nodedefs have, and the graph options that go with them.
const Bodies& bodies();
GraphOptions graph_options();

/// The surface of a graph's output "surfaceshader", recorded: stage by stage what
/// ShadingSystem::compile_material does, for those who time the stages.
class RecordedMaterial {
 public:
  /// Null, with the reason, where something has no body or is no surface.
  static std::unique_ptr<RecordedMaterial> record(const Graph& graph, Accuracy accuracy,
                                                  ParameterMode parameters, std::string& error,
                                                  Compensation compensation = Compensation::all);

  /// One entry point, cut at the state, for compile().
  Program program(Entry entry);
  /// Numbers of the floats per point that `begin` stores for the others.
  const std::vector<std::uint32_t>& state() const { return state_; }
  std::shared_ptr<const RecordedTextures> textures() const { return textures_; }

 private:
  RecordedMaterial();

  Recorder recorder_;
  Diagnostics diagnostics_;
  TextureStore store_;
  std::shared_ptr<RecordedTextures> textures_;
  SurfaceKernels kernels_;
  std::vector<std::uint32_t> state_;
};

/// An entry point as a kernel; those that read the state get what `begin` stored.
std::unique_ptr<KernelRun> run_material(const Graph& graph, ParameterMode parameters, Entry entry,
                                        const CompileOptions& options, std::string& error,
                                        Compensation compensation = Compensation::all);

}  // namespace nacre::bench
