#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jit/document/document.h"
#include "jit/graph/look/look.h"
#include "runtime/stop.h"

namespace nacre {

class ColorConfig;

/// Which implementation of a nodedef is taken where it has several.
enum class Preference : std::uint8_t {
  body,    ///< Our body or the host's, else the node graph, else the text.
  graph,   ///< The node graph, else as above.
  source,  ///< The text of an `<implementation>`, else as above.
};

/// How a document, or what a GraphBuilder was told, becomes a Graph.
struct GraphOptions {
  /// True for nodedefs that have a body of ours: they become nodes even where
  /// the library has a graph for them. Empty: those without a graph are taken to
  /// have one. A nodedef with neither, and no implementation by text, passes its
  /// `defaultinput` or `default` through, with a warning.
  std::function<bool(std::string_view nodedef)> is_native;
  Preference prefer = Preference::body;  ///< Where there is a choice.
  /// Colour spaces of the host, looked at before those that are built in. Where it
  /// lacks one end of a conversion the built-in spaces serve, if they have both; and one
  /// of each meet at its role aces_interchange.
  std::shared_ptr<const ColorConfig> colors;
  /// Colour space that the graph computes in, by any name that `colors` or
  /// `canonical_colorspace` knows; "": what the document's root says. "none": nothing
  /// is converted. Unset, or where the root says nothing: lin_rec709, which is what
  /// nodes that make colours of numbers (blackbody, artistic_ior) and the tool's
  /// pictures take for granted; only where `colors` has no way to that, its role scene_linear.
  std::optional<std::string> working_space;
  /// Colour space that colours of requested outputs are given in, by any such name; "",
  /// or "none": they stay in the working space. Materials do too.
  std::string output_space = {};
  /// What one unit of scene length is; lengths are converted to it.
  std::string distance_unit = "meter";
  /// Chooses the file of a sequence: replaces "{frame}" and "{0Nframe}" in file names
  /// as the texture node's framerange, frameoffset and frameendaction say. Without,
  /// they are kept.
  std::optional<int> frame;
  /// Replace "{NAME}" in file names; names that are not here are kept.
  std::map<std::string, std::string, std::less<>> host_attributes;
  /// Replace "<NAME>" in file names: the tokens of the geometry that the graph is
  /// for (Geometry Extensions, "Additional Filename Substitutions").
  std::map<std::string, std::string, std::less<>> geometry_tokens;
  /// Variants to apply, the last one first where two name the same input. A variant's
  /// inputs replace those of the document's shader nodes, and of other nodes that write
  /// an input of that name; its tokens replace all of that name (Specification,
  /// "Material Variants").
  std::vector<VariantChoice> variants;
  /// Read what the standard refuses but MaterialX 1.39.5 makes code of, as that code has
  /// it, with a warning for each: documents that other programs export rely on it. These
  /// are: no output named of several, or a wrong one of one (the first); inputs that the
  /// nodedef does not have (left out); a number for a vector, a vector for a colour and the
  /// like (jit/graph/resolve/lenient.h); too many numbers or commas in a value, and a value for a
  /// closure; an interface name that means nothing (the default); unconnected outputs (0);
  /// "" for an enumeration; colour spaces without a transform (as they are); declarations
  /// and elements that nothing can use.
  bool lenient = false;
  /// Inputs of the document's own nodes that have a default and no author are parameters too
  /// (Parameter::is_default).
  bool default_parameters = false;
  /// A graph with more nodes is refused: those that graphs stand for count too.
  std::size_t max_nodes = 250'000;
  /// A node with more inputs is refused.
  std::size_t max_inputs = 1024;
  /// Ends building, or checking, early, as an error.
  Stop stop = {};
};

/// The working space that the options mean for a document, by the name that says so.
std::string find_working_space(const GraphOptions& options, const Document& document);

}  // namespace nacre
