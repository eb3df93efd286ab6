#pragma once

#include <nacre/nacre.h>

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "jit/api/element_list.h"
#include "jit/api/exactness.h"
#include "jit/api/look_list.h"
#include "jit/api/nodedef_list.h"
#include "jit/api/shader_data.h"
#include "jit/compile/fitted_numbers.h"
#include "jit/document/document.h"
#include "jit/shading/shading_system.h"
#include "runtime/batch/binder.h"

// What a host's handles hold: what others need of it too is shared, so that the host may destroy
// them in any order.

namespace nacre::api {

/// What few hosts ask for: made of something when it is asked for first, by any thread.
template <class List>
class LazyList {
 public:
  template <class Of>
  const List& get(const Of& of) const {
    const std::scoped_lock lock(mutex_);
    if (!list_) list_.emplace(of);
    return *list_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::optional<List> list_;
};

}  // namespace nacre::api

namespace nacre::api {

/// What goes with the values of parameters, by entry: calls fill it in. Null where no kernel of the
/// shader reads such.
using FittedByEntry = std::unique_ptr<std::array<LastFitted, NACRE_ENTRY_COUNT>>;
FittedByEntry fitted_of(const ShaderData& shader);
inline LastFitted* last_of(const FittedByEntry& fitted, nacre_entry entry) {
  return fitted != nullptr ? &(*fitted)[entry] : nullptr;
}

}  // namespace nacre::api

struct nacre_system {
  std::shared_ptr<nacre::ShadingSystem> system;
  nacre::api::LazyList<nacre::api::NodeDefList> nodedefs;
};

/// A document, and the names in it that a host may ask for.
struct nacre_document {
  std::unique_ptr<nacre::Document> document;
  std::vector<std::string> materials;
  std::vector<std::string> outputs;
  nacre::api::LazyList<nacre::api::ElementList> elements;
  nacre::api::LazyList<nacre::api::LookList> looks;
};

struct nacre_shader {
  std::shared_ptr<const nacre::api::ShaderData> data;
  std::shared_ptr<const nacre::api::ShaderError> error = {};  ///< Null: nobody asks for it.
};

struct nacre_instance {
  std::shared_ptr<const nacre::api::ShaderData> data;
  std::vector<std::uint32_t> block;  ///< As ShaderData::block.
  /// What calls fit to them.
  nacre::api::FittedByEntry fitted;
};

struct nacre_binder {
  nacre::Binder binder;
};

struct nacre_stop {
  std::stop_source source;
};

namespace nacre::api {

/// Null: never.
inline Stop stop_of(const nacre_stop* stop) {
  return stop != nullptr ? Stop(stop->source.get_token()) : Stop();
}

}  // namespace nacre::api
