#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/diagnostic.h"
#include "runtime/node/recorded.h"
#include "runtime/node/texture_source.h"
#include "runtime/program/recorder.h"

namespace nacre {

/// One node being recorded: a body reads its inputs, records operations, and
/// sets its outputs. Port names and types are those of the nodedef; asking for
/// another is an error, "port-mismatch", and gives zeros.
class NodeCall {
 public:
  /// An input with its value, or an output to be given one.
  struct Port {
    /// As the nodedef has it.
    std::string name;
    Recorded value;  ///< Of an output only the type, until it is set.
  };

  /// For who records graphs. `outputs` have types and no values; `textures` may be null.
  NodeCall(Recorder& recorder, std::string_view category, std::string_view nodedef,
           std::vector<Port> inputs, std::vector<Port> outputs, Accuracy accuracy,
           TextureProvider* textures, Diagnostics& diagnostics, SourceLocation where);

  /// What operations on the inputs are recorded by, for inputs of the batch, tables and regions.
  Recorder& recorder() { return recorder_; }
  /// "mix"
  std::string_view category() const { return category_; }
  /// "ND_mix_color3"
  std::string_view nodedef() const { return nodedef_; }
  /// What the closure approximations and tables should aim at.
  Accuracy accuracy() const { return accuracy_; }
  /// Whether noise fades where a footprint covers its cells (nodes/noise/fade.h).
  bool fades_noise() const { return fades_noise_; }
  /// False unless set, by who records graphs.
  void fade_noise(bool fades) { fades_noise_ = fades; }
  /// Null where the host has no textures.
  TextureProvider* textures() { return textures_; }
  /// Where a body says what it cannot do. An error keeps the kernel from being made.
  Diagnostics& diagnostics() { return diagnostics_; }
  /// Of the node, for diagnostics.
  const SourceLocation& where() const { return where_; }

  /// Whether the nodedef has an input of that name.
  bool has(std::string_view name) const;
  /// An input of any type.
  const Recorded& in(std::string_view name) const;
  /// Of an input.
  Type type(std::string_view name) const { return in(name).type; }
  /// An input of type float; zero, as below, where that is an error.
  Float number(std::string_view name) const;
  /// An input of type integer.
  Int integer(std::string_view name) const;
  /// An input of type boolean.
  Bool boolean(std::string_view name) const;
  /// An input of type vector2.
  Float2 vector2(std::string_view name) const;
  Float3 vector3(std::string_view name) const;  ///< vector3 or color3.
  Float4 vector4(std::string_view name) const;  ///< vector4 or color4.
  /// string, filename or geomname; "" for inputs of other types.
  const std::string& text(std::string_view name) const;
  /// BSDF, EDF, VDF or a shader; null where nothing is connected.
  const ClosurePtr& closure(std::string_view name) const;

  /// Type of the first output, or of the one named.
  Type out_type() const { return outputs_.front().value.type; }
  /// Type of an output.
  Type out_type(std::string_view name) const;
  /// All of the nodedef, in its order.
  const std::vector<Port>& inputs() const { return inputs_; }
  /// All of the nodedef, in its order; a body reads their types.
  const std::vector<Port>& outputs() const { return outputs_; }

  /// Sets the first output. Scalars and vectors take the output's type.
  /// @{
  void set(Float x) { put(outputs_.front(), {x.ref()}); }
  void set(Int x) { put(outputs_.front(), {x.ref()}); }
  void set(Bool x) { put(outputs_.front(), {x.ref()}); }
  void set(Float2 v) { put(outputs_.front(), {v.x.ref(), v.y.ref()}); }
  void set(Float3 v) { put(outputs_.front(), {v.x.ref(), v.y.ref(), v.z.ref()}); }
  void set(Float4 v) { put(outputs_.front(), {v.x.ref(), v.y.ref(), v.z.ref(), v.w.ref()}); }
  void set(ClosurePtr closure);
  void set(std::vector<Ref> parts) { put(outputs_.front(), std::move(parts)); }
  /// @}
  /// Sets the first output to an input of the same type: numbers, text or closure.
  void copy(std::string_view input);
  /// Sets the output of that name; nothing if there is none.
  /// @{
  void set(std::string_view name, std::vector<Ref> parts);
  void set(std::string_view name, Float x) { set(name, std::vector<Ref>{x.ref()}); }
  void set(std::string_view name, Float2 v) { set(name, {v.x.ref(), v.y.ref()}); }
  void set(std::string_view name, Float3 v) { set(name, {v.x.ref(), v.y.ref(), v.z.ref()}); }
  /// @}

 private:
  static void put(Port& port, std::vector<Ref> parts);

  Recorder& recorder_;
  std::string category_;
  std::string nodedef_;
  std::vector<Port> inputs_;
  std::vector<Port> outputs_;
  Accuracy accuracy_;
  bool fades_noise_ = false;
  TextureProvider* textures_;
  Diagnostics& diagnostics_;
  SourceLocation where_;
};

/// A native implementation of every nodedef of one category.
struct NodeBody {
  std::string_view category;                   ///< "mix"
  std::function<void(NodeCall& call)> record;  ///< Reads inputs and sets outputs.
  /// Also in place of nodedefs for which the data library has a node graph.
  bool replaces_graphs = false;
};

}  // namespace nacre
