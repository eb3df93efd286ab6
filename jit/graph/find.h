#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/graph/look/look.h"
#include "runtime/diagnostic.h"
#include "runtime/type.h"

namespace nacre {

/// Something of a document that can be compiled.
struct FoundOutput {
  std::string name;        ///< As build_graph takes it: "NG_marble/out", "out".
  Type type = Type::none;  ///< None for one the standard does not have.
  /// Of its element.
  SourceLocation where;
};

/// The outputs of compound node graphs, then those at the root, in document
/// order. Graphs that implement nodedefs are not among them.
std::vector<FoundOutput> find_outputs(const Document& document);

/// A material node and what its inputs name.
struct FoundMaterial {
  std::string name;  ///< As ShadingSystem::compile_material takes it.
  /// Nodes, graphs or outputs that the shader inputs name, inherited ones too; "" where nothing
  /// is connected.
  /// @{
  std::string surfaceshader;
  std::string backsurfaceshader;
  std::string displacementshader;
  std::string volumeshader;
  std::string lightshader;
  /// @}
  /// Of the node.
  SourceLocation where;
};

/// Root nodes of type material, in document order.
std::vector<FoundMaterial> find_materials(const Document& document);

/// The element of that path, from the root down; null if there is none.
const Element* find_element(const Document& document, std::string_view path);

/// Its location; with nothing but the path if there is none.
SourceLocation location_of(const Document& document, std::string_view path);

/// Names of root nodes of a shader type that nothing at the root reads.
std::vector<FoundOutput> find_loose_shaders(const Document& document,
                                            const Definitions& definitions);

}  // namespace nacre
