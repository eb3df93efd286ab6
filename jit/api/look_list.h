#pragma once

#include <nacre/nacre.h>

#include <cstddef>
#include <string_view>
#include <vector>

#include "jit/document/document.h"
#include "jit/graph/look/look.h"

namespace nacre::api {

/// The looks of a document as hosts see them.
class LookList {
 public:
  /// What is wrong with looks is said by nacre_check. The document must outlive it.
  explicit LookList(const Document& document);

  std::size_t size() const { return looks_.size(); }
  const char* name(std::size_t look) const { return looks_[look].look.name.c_str(); }
  nacre_assignment assignment(std::size_t look, std::string_view geometry) const;
  bool is_visible(std::size_t look, std::string_view geometry, std::string_view rays,
                  std::string_view viewer) const;

 private:
  struct Row {
    Look look;
    /// Of each assignment, the look's before its own.
    std::vector<std::vector<nacre_variant>> variants;
  };

  Diagnostics unsaid_;
  std::vector<Row> looks_;
  GeometryRules rules_;
};

}  // namespace nacre::api
