#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "runtime/program/recorder.h"
#include "runtime/value/vector.h"

namespace nacre {

namespace detail {

template <class T>
std::vector<Ref> flatten(T value) {
  std::vector<Ref> refs;
  visit(value, [&](auto& scalar) { refs.push_back(scalar.ref()); });
  return refs;
}

/// `like` with its scalars replaced by `refs`, in visit order.
template <class T>
T rebuild(T like, const std::vector<Ref>& refs) {
  std::size_t next = 0;
  visit(like,
        [&](auto& scalar) { scalar = std::remove_reference_t<decltype(scalar)>(refs[next++]); });
  return like;
}

}  // namespace detail

/// body() in the lanes where `mask` holds, `otherwise` in the others. The work
/// of the body is skipped where no lane needs it, so use it around what is
/// expensive; `select` is cheaper for a few operations. A literal mask records
/// the body plainly, or not at all.
template <class T, class F>
T if_any(Bool mask, T otherwise, F&& body) {
  if (mask.is_constant(true)) return body();
  if (mask.is_constant(false)) return otherwise;
  Recorder& recorder = *mask.ref().recorder;
  recorder.begin_if(mask.ref());
  const T inside = body();
  const std::vector<Ref> inner = detail::flatten(inside);
  const std::vector<Ref> outer = detail::flatten(otherwise);
  std::vector<Ref> merged;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    // What is one value in the region is one behind it: the channels of a grey colour, say.
    std::size_t k = 0;
    while (k < i && !(same_value(inner[k], inner[i]) && same_value(outer[k], outer[i]))) ++k;
    merged.push_back(k < i ? merged[k] : recorder.merge(inner[i], outer[i]));
  }
  recorder.end_if();
  return detail::rebuild(otherwise, merged);
}

/// Repeats body(iteration, state) -> Bool at most `bound` times in the lanes
/// where `active` holds and every body so far returned true. Returns the state
/// each lane had when it stopped.
template <class T, class F>
T loop(Recorder& recorder, Bool active, int bound, T state, F&& body) {
  if (active.is_constant(false) || bound <= 0) return state;
  recorder.begin_loop(active.ref(), static_cast<std::uint32_t>(bound));
  std::vector<Ref> carries;
  for (const Ref initial : detail::flatten(state)) carries.push_back(recorder.carry(initial));
  const Ref count = recorder.carry(Ref::literal(0));
  T inside = detail::rebuild(state, carries);
  const Bool go_on = body(Int(count), inside);
  const std::vector<Ref> values = detail::flatten(inside);
  std::vector<Ref> finals;
  for (std::size_t i = 0; i < values.size(); ++i) {
    finals.push_back(recorder.next(carries[i], values[i]));
  }
  recorder.next(count, (Int(count) + Int(1)).ref());
  recorder.again(go_on.ref());
  recorder.end_loop();
  return detail::rebuild(state, finals);
}

/// A literal as an argument that outline() records no function of its own for.
template <class T>
T unspecialized(Recorder& recorder, T value) {
  visit(value, [&](auto& scalar) {
    const Ref ref = scalar.ref();
    if (!ref.is_constant()) return;
    scalar = std::remove_reference_t<decltype(scalar)>(
        Ref{&recorder, recorder.materialize(ref), ref.type});
  });
  return value;
}

/// Calls `body(arguments...)` as an outlined function: recorded once under
/// `name` and for each set of literal arguments, called wherever it is used.
/// The body sees literal arguments as literals; it must not use other recorded
/// values. R is a scalar, a vector or a structure with visit().
template <class R, class F, class... A>
R outline(Recorder& recorder, std::string_view name, F&& body, A... arguments) {
  std::vector<Ref> refs;
  (visit(arguments, [&](auto& scalar) { refs.push_back(scalar.ref()); }), ...);
  std::string key(name);
  std::vector<Ref> passed;
  std::vector<Scalar> types;
  for (const Ref ref : refs) {
    key += ref.is_constant() ? '=' + std::to_string(ref.id) : std::string("?");
    if (ref.is_constant()) continue;
    passed.push_back(ref);
    types.push_back(ref.type);
  }
  if (passed.empty()) return body(arguments...);
  std::uint32_t function = recorder.find_function(key);
  if (function == 0) {
    recorder.begin_function(key, std::string(name), types);
    std::uint32_t next = 0;
    const auto formal = [&](auto& scalar) {
      if (scalar.ref().is_constant()) return;
      scalar = std::remove_reference_t<decltype(scalar)>(recorder.argument(next++));
    };
    std::tuple<A...> formals(arguments...);
    std::apply([&](auto&... each) { (visit(each, formal), ...); }, formals);
    const R result = std::apply(body, formals);
    function = recorder.end_function(detail::flatten(result));
  }
  return detail::rebuild(R(), recorder.call(function, passed));
}

}  // namespace nacre
