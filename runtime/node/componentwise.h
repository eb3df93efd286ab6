#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/node/node_call.h"

namespace nacre {

/// Applies a scalar function to every component of the inputs and sets the
/// first output. An input with one component where the output has more is used
/// for all of them, so one body serves every overload of its node:
///
///   componentwise(call, {"fg", "bg", "mix"}, [](Float fg, Float bg, Float mix) { ... });
///
/// T is the scalar that the inputs hold: Float or Int.
template <class T = Float, std::size_t N, class F>
void componentwise(NodeCall& call, const std::array<std::string_view, N>& names, F&& f) {
  const auto count = static_cast<std::size_t>(component_count(call.out_type()));
  std::vector<Ref> parts;
  for (std::size_t component = 0; component < count; ++component) {
    const auto part = [&](std::size_t k) {
      const std::vector<Ref>& input = call.in(names[k]).parts;
      return T(input[input.size() == 1 ? 0 : component]);
    };
    parts.push_back([&]<std::size_t... K>(std::index_sequence<K...>) {
      return f(part(K)...).ref();
    }(std::make_index_sequence<N>()));
  }
  call.set(std::move(parts));
}

/// Names of inputs for `componentwise`.
template <class... S>
constexpr auto ports(S... names) {
  return std::array<std::string_view, sizeof...(S)>{names...};
}

/// As componentwise, for nodes with integer overloads as well: f is generic and
/// gets Ints where the first output is an integer.
template <std::size_t N, class F>
void componentwise_number(NodeCall& call, const std::array<std::string_view, N>& names, F&& f) {
  if (call.out_type() == Type::integer) {
    componentwise<Int>(call, names, f);
  } else {
    componentwise<Float>(call, names, f);
  }
}

}  // namespace nacre
