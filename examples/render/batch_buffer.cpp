#include "examples/render/batch_buffer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <new>

namespace nacre::host {

namespace {

/// Float arrays in a BatchBuffer besides its primvars, counted generously; an
/// assert in take() would notice too few.
constexpr std::size_t array_count = 160;

}  // namespace

LaneMemory::LaneMemory(std::size_t bytes) : size_(rounded(bytes)) {
  block_.reset(static_cast<std::byte*>(::operator new(size_, std::align_val_t(alignment))));
  std::memset(block_.get(), 0, size_);
}

void* LaneMemory::take(std::size_t bytes) {
  assert(used_ + rounded(bytes) <= size_);
  void* piece = block_.get() + used_;
  used_ += rounded(bytes);
  return piece;
}

BatchBuffer::BatchBuffer(std::uint32_t capacity, std::size_t state_bytes, std::size_t primvar_count)
    : capacity_(capacity),
      memory_((array_count + 5 * primvar_count) * LaneMemory::lane_bytes(capacity) +
              LaneMemory::rounded(state_bytes)) {
  ShadingBatch& b = batch;
  for (Lanes3* lanes : {&b.P,        &b.N,        &b.Ng,          &b.wo,          &b.T,    &b.B,
                        &b.P_object, &b.N_object, &b.T_object,    &b.B_object,    &b.dPdu, &b.dPdv,
                        &b.dPdx,     &b.dPdy,     &b.dPdx_object, &b.dPdy_object, &u,      &wi,
                        &rgb,        &sample.wi,  &sample.weight, &value.value}) {
    *lanes = memory_.lanes3(capacity);
  }
  for (Lanes3* lanes :
       {&through, &interior.absorption, &interior.scattering, &below.medium.absorption,
        &below.medium.scattering, &below.albedo, &below.normal, &within.medium.absorption,
        &within.medium.scattering, &within.emission}) {
    *lanes = memory_.lanes3(capacity);
  }
  for (Lanes2* lanes : {&b.uv, &b.dUVdx, &b.dUVdy}) *lanes = memory_.lanes2(capacity);
  b.times = memory_.floats(capacity);
  b.frames = memory_.floats(capacity);
  sample.pdf = memory_.floats(capacity);
  value.pdf = memory_.floats(capacity);
  interior.anisotropy = memory_.floats(capacity);
  interior.index = memory_.floats(capacity);
  b.exterior_index = memory_.floats(capacity);
  vacuum = memory_.floats(capacity);
  const std::size_t lanes = LaneMemory::lane_bytes(capacity) / sizeof(float);
  for (float* index : {b.exterior_index, vacuum}) std::fill_n(index, lanes, 1.f);
  b.min_alpha = memory_.floats(capacity);
  // Of points that nothing is drawn for, as those that light is estimated by: spread evenly.
  b.texture_u = memory_.floats(capacity);
  constexpr double golden = 0.6180339887498949;  // (sqrt(5) - 1) / 2
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double place = (static_cast<double>(lane) + 0.5) * golden;
    b.texture_u[lane] = static_cast<float>(place - std::floor(place)) * 0.999999f;
  }
  sample.alpha = memory_.floats(capacity);
  below.medium.anisotropy = memory_.floats(capacity);
  within.medium.anisotropy = memory_.floats(capacity);
  const std::size_t id_bytes = LaneMemory::lane_bytes(capacity);
  sample.flags = static_cast<std::uint32_t*>(memory_.take(id_bytes));
  sample.lobe = static_cast<std::int32_t*>(memory_.take(id_bytes));
  sample.kinds = static_cast<std::int32_t*>(memory_.take(id_bytes));
  value.kinds = static_cast<std::int32_t*>(memory_.take(id_bytes));
  b.lobes_wanted = static_cast<std::int32_t*>(memory_.take(id_bytes));
  std::fill_n(b.lobes_wanted, lanes, static_cast<std::int32_t>(all_lobes));
  geometry_id = static_cast<std::uint32_t*>(memory_.take(id_bytes));
  primitive_id = static_cast<std::uint32_t*>(memory_.take(id_bytes));
  primvars.resize(primvar_count);
  for (MatrixLanes* matrix : {&b.object_to_world, &b.world_to_object}) {
    for (float*& entry : *matrix) entry = memory_.floats(capacity);
  }
  for (PrimvarLanes& p : primvars) {
    p.present = static_cast<std::int32_t*>(memory_.take(id_bytes));
    for (float*& component : p.component) component = memory_.floats(capacity);
  }
  state = memory_.take(state_bytes);
  b.geometry_id = geometry_id;
  b.primitive_id = primitive_id;
}

}  // namespace nacre::host
