#pragma once

#include <vector>

#include "runtime/node/recorded.h"

namespace nacre {

/// A vector of any size times a power of two that keeps its square from
/// overflowing and from vanishing: |v| = sqrt(squared) unscale.
struct ScaledVector {
  std::vector<Float> components;
  Float squared;
  Float unscale;
};

inline ScaledVector scale_vector(const Recorded& v) {
  Float largest = 0.0f;
  for (std::size_t i = 0; i < v.parts.size(); ++i) largest = max(abs(v.number(i)), largest);
  const Bool big = largest > 0x1p60f;
  const Bool small = largest < 0x1p-60f;
  const Float scale = select(big, 0x1p-68f, select(small, Float(0x1p68f), 1.0f));
  ScaledVector result;
  result.unscale = select(big, 0x1p68f, select(small, Float(0x1p-68f), 1.0f));
  for (std::size_t i = 0; i < v.parts.size(); ++i) {
    const Float component = v.number(i) * scale;
    result.components.push_back(component);
    result.squared = i == 0 ? component * component : fma(component, component, result.squared);
  }
  return result;
}

/// v / |v|; zero for the zero vector. Zero or NaN components where one is infinite.
inline std::vector<Float> unit_vector(const Recorded& v) {
  const ScaledVector scaled = scale_vector(v);
  const Float inverse = select(scaled.squared > 0.0f, 1.0f / sqrt(scaled.squared), 0.0f);
  std::vector<Float> result;
  for (const Float& component : scaled.components) result.push_back(component * inverse);
  return result;
}

}  // namespace nacre
