#pragma once

#include <vector>

#include "pbs/view.h"
#include "runtime/node/geometry.h"

namespace nacre {

inline bool same_value(Ref a, Ref b) {
  return a.recorder == b.recorder && a.id == b.id && a.type == b.type;
}
inline bool same_value(Float3 a, Float3 b) {
  return same_value(a.x.ref(), b.x.ref()) && same_value(a.y.ref(), b.y.ref()) &&
         same_value(a.z.ref(), b.z.ref());
}

/// What a lobe works out once for a view: a structure with visit(). Recorded at
/// top level, as the kernels do when they ask for albedo and throughput, it serves
/// every later use; seen from the viewer it is kept too, so that `begin` computes
/// it and the other kernels load it. Lives while one Program is recorded.
template <class T>
class PerView {
 public:
  template <class F>
  T get(const View& view, F&& compute) const {
    if (const T* known = find(view)) return *known;
    T value = compute();
    if (!view.recorder->at_top_level()) return value;
    if (same_value(view.wo, view_direction(*view.recorder))) {
      visit(value, [&](auto& scalar) { scalar = keep(*view.recorder, scalar); });
    }
    known_.push_back({view.wo, view.thin_walled, value});
    return value;
  }

 private:
  struct Known {
    Float3 wo;
    Bool thin_walled;
    T value;
  };
  const T* find(const View& view) const {
    for (const Known& known : known_) {
      if (same_value(known.wo, view.wo) &&
          same_value(known.thin_walled.ref(), view.thin_walled.ref())) {
        return &known.value;
      }
    }
    return nullptr;
  }
  mutable std::vector<Known> known_;
};

}  // namespace nacre
