#pragma once

#include <vector>

#include "pbs/view.h"
#include "runtime/node/geometry.h"
#include "runtime/value/control.h"

namespace nacre {

/// What a lobe works out once for a view: a structure with visit(). Recorded at
/// top level, as Lobe::prepare is, it serves every later use; seen from the viewer
/// it is kept too, so that `begin` computes it and the other kernels load it. Lives
/// while one Program is recorded.
template <class T>
class PerView {
 public:
  /// Works it out in the lanes where `mask` holds; zeros elsewhere. A lobe that
  /// several branches share may be prepared again: then for all of them.
  template <class F>
  void prepare(const View& view, Bool mask, F&& compute) const {
    if (!view.recorder->at_top_level()) return;
    const Known* known = find(view);
    if (known != nullptr) {
      if (known->mask.is_constant(true) || same_value(known->mask.ref(), mask.ref())) return;
      mask = known->mask | mask;
    }
    T value = if_any(mask, T(), compute);
    if (same_value(view.wo, view_direction(*view.recorder))) {
      visit(value, [&](auto& scalar) { scalar = keep(*view.recorder, scalar); });
    }
    known_.insert(known_.begin(), {view.wo, view.thin_walled, mask, value});
  }

  template <class F>
  T get(const View& view, F&& compute) const {
    if (const Known* known = find(view)) return known->value;
    return compute();
  }

 private:
  struct Known {
    Float3 wo;
    Bool thin_walled;
    Bool mask;
    T value;
  };
  const Known* find(const View& view) const {
    for (const Known& known : known_) {
      if (same_value(known.wo, view.wo) &&
          same_value(known.thin_walled.ref(), view.thin_walled.ref())) {
        return &known;
      }
    }
    return nullptr;
  }
  mutable std::vector<Known> known_;  ///< The latest first.
};

}  // namespace nacre
