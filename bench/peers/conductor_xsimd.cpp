#include <xsimd/xsimd.hpp>

#include "bench/peers/peers.h"

namespace {

using Batch = xsimd::batch<float>;
constexpr float tiny = 1e-30f;

Batch square(Batch x) { return x * x; }

/// Conductor reflectance, both polarisations (pbs/fresnel.cpp has the formula).
Batch fresnel(Batch cosine, float n, float k) {
  const Batch cosine2 = square(cosine);
  const Batch sine2 = xsimd::max(Batch(1.0f) - cosine2, Batch(0.0f));
  const Batch t = Batch((n - k) * (n + k)) - sine2;
  const Batch product(n * k);
  const Batch modulus = xsimd::sqrt(xsimd::fma(t, t, Batch(4.0f * (n * k) * (n * k))));
  const Batch greater = xsimd::sqrt(Batch(0.5f) * (modulus + xsimd::abs(t)));
  const Batch smaller = product / xsimd::max(greater, Batch(tiny));
  const auto mostly_real = t > Batch(0.0f);
  const Batch a = xsimd::select(mostly_real, greater, smaller);
  const Batch b2 = square(xsimd::select(mostly_real, smaller, greater));
  const Batch rest = b2 + Batch(tiny);
  const Batch s = (square(a - cosine) + rest) / (square(a + cosine) + rest);
  const Batch ac = a * cosine;
  const Batch bc2 = xsimd::fma(b2, cosine2, Batch(tiny));
  const Batch p = (square(ac - sine2) + bc2) / (square(ac + sine2) + bc2);
  const Batch one(1.0f);
  return Batch(0.5f) * (xsimd::min(s, one) + xsimd::min(s * p, one));
}

struct Vector {
  Batch x, y, z;
};

Batch root_of(Vector w, Batch ax, Batch ay) {
  return xsimd::sqrt(xsimd::fma(ax * w.x, ax * w.x, xsimd::fma(ay * w.y, ay * w.y, w.z * w.z)));
}

struct Value {
  Batch f, cosine, pdf;
};

Value reflect(Vector wo, Vector wi, Batch ax, Batch ay) {
  const Batch zero(0.0f);
  const Vector h{wo.x + wi.x, wo.y + wi.y, wo.z + wi.z};
  const Batch length2 = xsimd::fma(h.x, h.x, xsimd::fma(h.y, h.y, h.z * h.z));
  const auto seen = (wo.z > zero) && (wi.z > zero) && (length2 > Batch(1e-8f));
  // Half the distribution of normals.
  const Batch area = ax * ay;
  const Vector q{h.x * ay, h.y * ax, h.z * area};
  const Batch q2 = xsimd::fma(q.x, q.x, xsimd::fma(q.y, q.y, q.z * q.z));
  const Batch ratio = area * length2 / xsimd::max(q2, Batch(tiny));
  const Batch half_d = Batch(0.5f * 0.31830988618f) * area * square(ratio);
  // The bound of Eto and Tokuyoshi 2023.
  const Batch a2 = square(xsimd::min(ax, ay));
  const Batch s2 = square(Batch(1.0f) + xsimd::sqrt(xsimd::fma(wo.x, wo.x, square(wo.y))));
  const Batch bound = (Batch(1.0f) - a2) * s2 / xsimd::fma(a2, square(wo.z), s2);
  const Batch root = root_of(wo, ax, ay);
  const Batch pdf = half_d / xsimd::max(xsimd::fma(bound, wo.z, root), Batch(tiny));
  const Batch both = xsimd::fma(wi.z, root, wo.z * root_of(wi, ax, ay));
  const Batch f = half_d * wi.z / xsimd::max(both, Batch(tiny));
  const Batch cosine = xsimd::min(Batch(0.5f) * xsimd::sqrt(length2), Batch(1.0f));
  return {xsimd::select(seen, f, zero), cosine, xsimd::select(seen, pdf, zero)};
}

}  // namespace

extern "C" void nacre_peer_conductor(const NacreConductor* c, std::size_t count) {
  const auto load = [](const float* from) { return Batch::load_unaligned(from); };
  for (std::size_t i = 0; i < count; i += Batch::size) {
    const Value value = reflect({load(c->wo_x + i), load(c->wo_y + i), load(c->wo_z + i)},
                                {load(c->wi_x + i), load(c->wi_y + i), load(c->wi_z + i)},
                                load(c->alpha_x + i), load(c->alpha_y + i));
    (value.f * fresnel(value.cosine, c->n[0], c->k[0])).store_unaligned(c->f_x + i);
    (value.f * fresnel(value.cosine, c->n[1], c->k[1])).store_unaligned(c->f_y + i);
    (value.f * fresnel(value.cosine, c->n[2], c->k[2])).store_unaligned(c->f_z + i);
    value.pdf.store_unaligned(c->pdf + i);
  }
}
