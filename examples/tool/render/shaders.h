#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "examples/render/scene.h"
#include "examples/tool/options.h"
#include "examples/tool/render/kernel_light.h"
#include "examples/tool/render/kernel_shader.h"
#include "examples/tool/render/options.h"
#include "examples/tool/scene/assignment.h"

namespace nacre::tool {

/// What shades the two sides of meshes.
struct TwoShaders {
  std::unique_ptr<KernelShader> front;
  std::unique_ptr<KernelShader> back;  ///< Null: as the front.

  /// Those that are there.
  std::vector<const KernelShader*> all() const {
    if (back == nullptr) return {front.get()};
    return {front.get(), back.get()};
  }
};

/// What shades a scene. The store that it is of lives as long.
struct SceneShaders {
  std::vector<const TwoShaders*> by_mesh;  ///< Null: neutral.
  std::vector<bool> solids;                ///< RenderInput::solids
  const KernelShader* neutral = nullptr;
  std::vector<const KernelLight*> lights;  ///< Of the document.

  /// What a render calls.
  std::vector<const BoundKernel*> kernels() const;
};

/// The kernels of a run. Each is made when a scene asks for it first, and there for all frames and
/// cameras that ask for the same.
class RenderShaders {
 public:
  /// All of these live as long.
  RenderShaders(RenderOptions& options, const Opened& opened, RenderStop& stop);

  /// For a scene, its meshes and what goes on them at a frame; nothing after an error. Completes
  /// what RenderOptions says of values that passes want.
  std::optional<SceneShaders> of(const host::Scene& world,
                                 const std::vector<MeshAssignment>& assignments, float frame,
                                 Diagnostics& diagnostics);

  /// Where materials were shaded, of those that were: RenderOptions::points_file.
  RecordedPoints recorded() const;

 private:
  struct Request;
  struct Made {
    std::string material;
    TwoShaders shaders;
    bool walks = false;  ///< Light below its surface is followed where that is around a solid.
  };

  const TwoShaders* find(Request request, Diagnostics& diagnostics);
  bool make(const Request& request, Made& made, Diagnostics& diagnostics);
  bool compile_lights(int frame, Diagnostics& diagnostics);
  bool make_neutral(Diagnostics& diagnostics);

  RenderOptions& options_;
  const Opened& opened_;
  RenderStop& stop_;
  bool names_frames_;  ///< What is compiled depends on the frame.
  std::map<std::string, Made> made_;
  std::map<int, std::vector<std::unique_ptr<KernelLight>>> lights_;  ///< By frame.
  std::unique_ptr<KernelShader> neutral_;
};

/// Says of which materials and lights a kernel took too many steps.
void report_failed(const Opened& opened, const std::vector<MeshAssignment>& assignments,
                   const SceneShaders& shaders, Diagnostics& diagnostics);

}  // namespace nacre::tool
