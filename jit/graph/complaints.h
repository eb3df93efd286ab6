#pragma once

#include <string>
#include <string_view>
#include <unordered_set>

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// How making a graph complains about elements. Graphs within graphs meet the same element
/// in many contexts: of each, a warning is given once.
class Complaints {
 public:
  Complaints(Diagnostics& diagnostics, bool lenient)
      : diagnostics_(diagnostics), lenient_(lenient) {}

  void error(std::string code, const Element& element, std::string message,
             std::string expected = {}, std::string found = {}, std::string hint = {});
  void warning(std::string code, const Element& element, std::string message,
               std::string expected = {}, std::string found = {}, std::string hint = {});
  /// True, with a warning that ends in `so`, where GraphOptions::lenient goes on; else an
  /// error.
  bool tolerates(std::string code, const Element& element, const std::string& message,
                 std::string_view so, std::string expected = {}, std::string found = {},
                 std::string hint = {});
  /// Hands on what was said of an element.
  void add(const Diagnostics& said, const Element& element);

  bool is_lenient() const { return lenient_; }
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  bool is_new(const std::string& code, const Element& element) {
    return warned_.insert(code + element_path(element)).second;
  }

  Diagnostics& diagnostics_;
  const bool lenient_;
  std::unordered_set<std::string> warned_;
};

}  // namespace nacre
