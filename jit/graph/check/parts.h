#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/graph/options.h"
#include "runtime/diagnostic.h"
#include "runtime/type.h"

/// The parts of check_document, one for each kind of fault.
namespace nacre {

/// What the parts complain through.
class ElementCheck {
 protected:
  explicit ElementCheck(Diagnostics& diagnostics, bool lenient = false)
      : diagnostics_(diagnostics), lenient_(lenient) {}

  void error(std::string code, const Element& element, std::string message,
             std::string expected = {}, std::string found = {}, std::string hint = {}) {
    diagnostics_.error(std::move(code), location(element), std::move(message), std::move(expected),
                       std::move(found), std::move(hint));
  }
  void warning(std::string code, const Element& element, std::string message,
               std::string expected = {}, std::string found = {}, std::string hint = {}) {
    diagnostics_.warning(std::move(code), location(element), std::move(message),
                         std::move(expected), std::move(found), std::move(hint));
  }

  /// An error, or with GraphOptions::lenient a warning that ends in `so`, in the same words
  /// as building the graph says it.
  void tolerable(std::string code, const Element& element, std::string message, std::string_view so,
                 std::string expected = {}, std::string found = {}, std::string hint = {}) {
    if (!lenient_) {
      error(std::move(code), element, std::move(message), std::move(expected), std::move(found),
            std::move(hint));
      return;
    }
    message.append(", so ").append(so);
    warning(std::move(code), element, std::move(message), std::move(expected), std::move(found),
            std::move(hint));
  }

  Diagnostics& diagnostics_;
  bool lenient_;
};

/// Elements without a name, in places where they mean nothing, of versions gone by;
/// attributes that are almost one of the standard's.
void check_structure(const Document& document, const Definitions& definitions, bool lenient,
                     Diagnostics& diagnostics);

/// Nodedefs, implementations, types, units, geometric properties, targets.
void check_declarations(const Document& document, const Definitions& definitions, bool lenient,
                        Diagnostics& diagnostics);

// The parts of check_declarations that have a file of their own.
void check_nodedefs(const Document& document, const Definitions& definitions, bool lenient,
                    Diagnostics& diagnostics);
void check_implementations(const Document& document, const Definitions& definitions, bool lenient,
                           Diagnostics& diagnostics);
void check_typedefs(const Document& document, const Definitions& definitions,
                    Diagnostics& diagnostics);

/// An <input> or <output>: its type, what it is connected to, its value, unit and tokens.
void check_port(const Element& port, const Definitions& definitions, bool lenient,
                Diagnostics& diagnostics);
void check_token(const Element& token, const Definitions& definitions, Diagnostics& diagnostics);

/// Looks and what they assign: materials, collections, properties, variants.
void check_looks(const Document& document, const Definitions& definitions,
                 Diagnostics& diagnostics);

/// True for the name of a <typedef>.
bool is_declared_type(std::string_view name, const Element& user, const Definitions& definitions);

/// Reports a port whose `type` is missing or the name of no type; false after that.
bool check_type_name(const Element& port, const Definitions& definitions, Diagnostics& diagnostics);

/// "'text'", cut if it is long.
std::string in_quotes(std::string_view text);

}  // namespace nacre
