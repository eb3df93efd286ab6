#pragma once

#include <memory>
#include <optional>

#include "jit/document/library.h"
#include "jit/graph/build/build.h"
#include "jit/graph/color/color_config.h"
#include "jit/record/bodies.h"
#include "jit/record/text_bodies.h"
#include "jit/service/compile_service.h"
#include "jit/shading/shading_system.h"
#include "runtime/texture/texture_store.h"

namespace nacre {

/// What a ShadingSystem consists of. Never changed once made, but for what its members
/// remember; those may be used from any thread.
struct SystemParts {
  std::shared_ptr<const Library> library;
  std::unique_ptr<Bodies> bodies;
  std::unique_ptr<TextBodies> texts;
  std::shared_ptr<const ColorConfig> colors;
  std::unique_ptr<TextureStore> textures;
  FileResolver resolver;
  std::shared_ptr<CompileService> service;

  /// Null, with diagnostics, if the library or the colour configuration cannot be read.
  static std::unique_ptr<SystemParts> create(const SystemOptions& options,
                                             Diagnostics& diagnostics);

  /// The options of a graph that bodies and colours of this system are for.
  GraphOptions graph_options(const ShaderOptions& options) const;
  std::optional<Graph> build(const Document& document, const GraphRequest& request,
                             const ShaderOptions& options, Diagnostics& diagnostics) const;
};

}  // namespace nacre
