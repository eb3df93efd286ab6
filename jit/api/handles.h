#pragma once

#include <nacre/nacre.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "jit/api/shader_data.h"
#include "jit/document/document.h"
#include "jit/shading/shading_system.h"
#include "runtime/batch/binder.h"

// What a host's handles hold: what others need of it too is shared, so that the host may destroy
// them in any order.

struct nacre_system {
  std::shared_ptr<nacre::ShadingSystem> system;
};

/// A document, and the names in it that a host may ask for.
struct nacre_document {
  std::unique_ptr<nacre::Document> document;
  std::vector<std::string> materials;
  std::vector<std::string> outputs;
};

struct nacre_shader {
  std::shared_ptr<const nacre::api::ShaderData> data;
};

struct nacre_instance {
  std::shared_ptr<const nacre::api::ShaderData> data;
  std::vector<std::uint32_t> block;  ///< As ShaderData::block.
};

struct nacre_binder {
  nacre::Binder binder;
};
