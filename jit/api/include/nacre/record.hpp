/// \file
/// <nacre/record.h> for C++17, nodes and lobes as classes: part of <nacre/nacre.hpp>.
#ifndef NACRE_RECORD_HPP
#define NACRE_RECORD_HPP

#include <nacre/nacre.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <nacre/values.hpp>
#include <string>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {

/// From where a lobe is looked at.
struct View {
  nacre_recorder* recorder = nullptr;
  Float3 wo;  ///< Unit, world space, from the point to the viewer.
  int accuracy = NACRE_STANDARD;
  Bool thin_walled = false;  ///< Light that enters leaves at the same point.
};

/// A lobe seen along one pair of directions.
struct LobeValue {
  Float3 f;   ///< Scattering function times |cos(wi)|.
  Float pdf;  ///< Of wi, by solid angle.
};

/// A direction that a lobe chose.
struct LobeSample {
  Float3 wi;           ///< Unit, world space.
  Bool valid;          ///< False: lost.
  Bool delta = false;  ///< wi is one of finitely many.
  Float3 delta_weight = Float3(0.0f);
  Float delta_probability = 0.0f;
};

template <class F>
void visit(LobeValue& value, F&& f) {
  visit(value.f, f), f(value.pdf);
}

/// One term of a BSDF, of weight 1; see nacre_lobe. Its members are recorded values, prepared and
/// kept by the body that makes it.
class Lobe {
 public:
  virtual ~Lobe() = default;
  virtual const char* name() const = 0;
  virtual int kinds() const = 0;
  virtual LobeValue evaluate(const View& view, Float3 wi) const = 0;
  virtual LobeSample sample(const View& view, Float3 u) const = 0;
  virtual Float3 albedo(const View& view) const = 0;
  virtual Float3 throughput(const View& view) const {
    return is_opaque() ? Float3(0.0f) : Float3(1.0f) - albedo(view);
  }
  virtual bool is_opaque() const { return false; }
  /// For renderers' images.
  /// @{
  virtual Float3 normal(const View& view) const {
    const auto channel = [&](const char* name) {
      return Float(nacre_read_channel(view.recorder, name, NACRE_FLOAT));
    };
    return {channel("N.x"), channel("N.y"), channel("N.z")};
  }
  virtual Float roughness(const View&) const { return 1.0f; }
  /// @}
};

namespace detail {

inline View view_of(const nacre_view* view) {
  return {view->recorder,
          {Float(view->wo[0]), Float(view->wo[1]), Float(view->wo[2])},
          view->accuracy,
          Bool(view->thin_walled)};
}
inline Float3 three(const nacre_value* v) { return {Float(v[0]), Float(v[1]), Float(v[2])}; }
inline void put(nacre_value* to, Float3 v) {
  to[0] = v.x.value(), to[1] = v.y.value(), to[2] = v.z.value();
}
inline const Lobe& lobe_of(void* user) { return **static_cast<std::shared_ptr<Lobe>*>(user); }

}  // namespace detail

/// A node whose body is running.
class Node {
 public:
  explicit Node(nacre_node* node) : node_(node) {}

  nacre_recorder* recorder() const { return nacre_node_recorder(node_); }
  std::string nodedef() const { return nacre_node_nodedef(node_); }
  int accuracy() const { return nacre_node_accuracy(node_); }
  std::string input_type(const std::string& name) const {
    return nacre_node_input_type(node_, name.c_str());
  }
  std::string output_type() const { return nacre_node_output_type(node_, nullptr); }

  /// Inputs by name; another type or name is an error at the node, and zeros.
  /// @{
  Float number(const std::string& name) const { return Float(numbers<1>(name)[0]); }
  Int integer(const std::string& name) const {
    return Int(numbers<1>(name, nacre_literal_int(0))[0]);
  }
  Bool boolean(const std::string& name) const {
    return Bool(numbers<1>(name, nacre_literal_bool(0))[0]);
  }
  Float2 vector2(const std::string& name) const {
    const auto v = numbers<2>(name);
    return {Float(v[0]), Float(v[1])};
  }
  Float3 vector3(const std::string& name) const { return detail::three(numbers<3>(name).data()); }
  Float4 vector4(const std::string& name) const {
    const auto v = numbers<4>(name);
    return {Float(v[0]), Float(v[1]), Float(v[2]), Float(v[3])};
  }
  std::string text(const std::string& name) const { return nacre_node_text(node_, name.c_str()); }
  /// @}

  /// A channel of the batch, "P.x" or one of the host's own.
  Float channel(const std::string& name) const {
    return Float(nacre_read_channel(recorder(), name.c_str(), NACRE_FLOAT));
  }
  /// A number that an instance sets.
  Float slot(const std::string& name, float value) const {
    return Float(nacre_read_slot(recorder(), name.c_str(), nacre_literal_float(value)));
  }
  /// Entries of a table, its index clamped.
  Float look_up(const std::string& name, const std::vector<float>& table, Int index) const {
    const std::uint32_t number = nacre_table(recorder(), name.c_str(), table.data(), table.size());
    return Float(detail::record(NACRE_LOOK_UP, number, index));
  }

  /// Sets the first output, or the one of that name.
  /// @{
  template <class T>
  void set(T value) {
    const std::vector<nacre_value> list = detail::flatten(value);
    nacre_node_set(node_, nullptr, list.data(), list.size());
  }
  template <class T>
  void set(const std::string& output, T value) {
    const std::vector<nacre_value> list = detail::flatten(value);
    nacre_node_set(node_, output.c_str(), list.data(), list.size());
  }
  /// @}
  /// Sets the first output, a BSDF, to a lobe times the input "weight".
  void set_lobe(std::shared_ptr<Lobe> lobe) {
    nacre_lobe made{};
    made.size = sizeof made;
    made.name = lobe->name();
    made.kinds = lobe->kinds();
    made.is_opaque = lobe->is_opaque();
    made.user = new std::shared_ptr<Lobe>(std::move(lobe));
    made.destroy = [](void* user) { delete static_cast<std::shared_ptr<Lobe>*>(user); };
    made.evaluate = [](void* user, const nacre_view* view, const nacre_value* wi, nacre_value* f,
                       nacre_value* pdf) {
      const LobeValue value =
          detail::lobe_of(user).evaluate(detail::view_of(view), detail::three(wi));
      detail::put(f, value.f);
      *pdf = value.pdf.value();
    };
    made.sample = [](void* user, const nacre_view* view, const nacre_value* u,
                     nacre_lobe_sample* to) {
      const LobeSample from = detail::lobe_of(user).sample(detail::view_of(view), detail::three(u));
      detail::put(to->wi, from.wi);
      to->valid = from.valid.value();
      to->delta = from.delta.value();
      detail::put(to->delta_weight, from.delta_weight);
      to->delta_probability = from.delta_probability.value();
    };
    made.albedo = [](void* user, const nacre_view* view, nacre_value* rgb) {
      detail::put(rgb, detail::lobe_of(user).albedo(detail::view_of(view)));
    };
    made.throughput = [](void* user, const nacre_view* view, nacre_value* rgb) {
      detail::put(rgb, detail::lobe_of(user).throughput(detail::view_of(view)));
    };
    made.normal = [](void* user, const nacre_view* view, nacre_value* xyz) {
      detail::put(xyz, detail::lobe_of(user).normal(detail::view_of(view)));
    };
    made.roughness = [](void* user, const nacre_view* view, nacre_value* roughness) {
      *roughness = detail::lobe_of(user).roughness(detail::view_of(view)).value();
    };
    nacre_node_set_lobe(node_, &made);
  }
  /// Keeps the kernel from being made.
  void error(const std::string& message) { nacre_node_error(node_, message.c_str()); }

 private:
  template <std::size_t count>
  std::array<nacre_value, count> numbers(const std::string& name,
                                         nacre_value otherwise = nacre_literal_float(0)) const {
    std::array<nacre_value, count> values;
    values.fill(otherwise);
    const std::size_t found = nacre_node_input(node_, name.c_str(), values.data(), count);
    if (found == count && values[0].type == otherwise.type) return values;
    if (found != 0) {
      nacre_node_error(node_, ("input '" + name + "' has another type").c_str());
    }
    values.fill(otherwise);
    return values;
  }

  nacre_node* node_;
};

/// A nodedef that a host implements.
struct Body {
  std::string nodedef;  ///< "ND_my_noise_float", declared by one of the libraries.
  /// By any thread that compiles. What it throws is an error at the node.
  std::function<void(Node& node)> record;
};

}  // namespace v0
}  // namespace nacre

#endif
