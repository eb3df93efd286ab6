#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "examples/render/fibre.h"
#include "examples/render/shader.h"
#include "examples/render/vec.h"

namespace nacre::host {

inline Vec3 load(const Lanes3& lanes, std::size_t i) {
  return {lanes.x[i], lanes.y[i], lanes.z[i]};
}
inline void store(const Lanes3& lanes, std::size_t i, Vec3 v) {
  lanes.x[i] = v.x, lanes.y[i] = v.y, lanes.z[i] = v.z;
}
inline void store(const Lanes2& lanes, std::size_t i, Vec2 v) {
  lanes.x[i] = v.x, lanes.y[i] = v.y;
}

/// Where the mesh of a point is at the time of its ray.
struct Pose {
  Affine to_world, to_object;
  bool mirrors = false;  ///< to_world does; counted only where it is yet to be applied.
};

/// One zeroed block of memory, handed out in 64-byte aligned pieces.
class LaneMemory {
 public:
  static constexpr std::size_t alignment = 64;

  explicit LaneMemory(std::size_t bytes);
  void* take(std::size_t bytes);
  float* floats(std::uint32_t capacity) { return static_cast<float*>(take(lane_bytes(capacity))); }
  Lanes2 lanes2(std::uint32_t capacity) { return {floats(capacity), floats(capacity)}; }
  Lanes3 lanes3(std::uint32_t capacity) {
    return {floats(capacity), floats(capacity), floats(capacity)};
  }

  static std::size_t rounded(std::size_t bytes) {
    return (bytes + alignment - 1) / alignment * alignment;
  }
  /// Bytes of one float array, padded as shader.h says; and so that arrays after each other do not
  /// meet in the same sets of the caches (bench/results/hosts.md, "a_page_apart").
  static std::size_t lane_bytes(std::uint32_t capacity) {
    const std::size_t bytes =
        rounded(sizeof(float) * ((capacity + lane_padding - 1) / lane_padding * lane_padding));
    return bytes % 1024 == 0 ? bytes + alignment : bytes;
  }

 private:
  struct Free {
    void operator()(std::byte* p) const { ::operator delete(p, std::align_val_t(alignment)); }
  };
  std::unique_ptr<std::byte, Free> block_;
  std::size_t used_ = 0, size_ = 0;
};

/// Everything one thread needs to call the kernels of a material on up to
/// `capacity` points, allocated once.
class BatchBuffer {
 public:
  BatchBuffer(std::uint32_t capacity, std::size_t state_bytes, std::size_t primvars);

  std::uint32_t capacity() const { return capacity_; }

  ShadingBatch batch;
  std::vector<PrimvarLanes> primvars;  ///< Storage behind batch.primvars.
  std::vector<Pose> poses;             ///< Of the points, while they are filled in.
  std::vector<FibrePoint> fibres;      ///< Likewise, of those on fibres.
  std::uint32_t* geometry_id;
  std::uint32_t* primitive_id;
  void* state;
  Lanes3 through;  ///< From P to the other side of the fibre; 0 on surfaces.
  Lanes3 u;        ///< Random numbers for sample().
  Lanes3 wi;       ///< Directions for evaluate().
  Lanes3 rgb;      ///< emission() or opacity().
  float* vacuum;   ///< The index of vacuum, for all points.
  SampleLanes sample;
  EvaluateLanes value;
  InteriorLanes interior;
  VolumeLanes within;
  SubsurfaceLanes below;

 private:
  std::uint32_t capacity_;
  LaneMemory memory_;
};

}  // namespace nacre::host
