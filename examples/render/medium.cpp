#include "examples/render/medium.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre::host {

namespace {

/// exp(-rate distance), with 0 times infinity 0.
float left_after(float rate, float distance) {
  return rate > 0.f ? std::exp(-rate * distance) : 1.f;
}

Vec3 left_after(Vec3 rate, float distance) {
  return {left_after(rate.x, distance), left_after(rate.y, distance), left_after(rate.z, distance)};
}

}  // namespace

Flight sample_flight(const Medium& medium, Vec3 throughput, float far, Uniform2 u) {
  const Vec3 rate = medium.absorption + medium.scattering;
  if (max_component(medium.scattering) <= 0.f) return {false, 0.f, left_after(rate, far)};
  const float total = throughput.x + throughput.y + throughput.z;
  if (!(total > 0.f)) return {};
  const Vec3 chance = (1.f / total) * throughput;
  const float of_channel = u.x < chance.x ? rate.x : u.x < chance.x + chance.y ? rate.y : rate.z;
  const float distance = of_channel > 0.f ? -std::log1p(-u.y) / of_channel : INFINITY;
  if (!(distance < far)) {
    const Vec3 left = left_after(rate, far);
    const float probability = dot(chance, left);
    return {false, 0.f, probability > 0.f ? (1.f / probability) * left : Vec3{}};
  }
  const Vec3 left = left_after(rate, distance);
  const float pdf = dot(chance, rate * left);
  return {true, distance, pdf > 0.f ? (1.f / pdf) * (medium.scattering * left) : Vec3{}};
}

Vec3 transmittance(const Medium& medium, float length) {
  return left_after(medium.absorption + medium.scattering, length);
}

Vec3 emitted(const Medium& medium, float length) {
  const Vec3 rate = medium.absorption + medium.scattering;
  const auto of = [&](float emission, float r) {
    if (!(emission > 0.f)) return 0.f;
    if (r * length > 1e-4f) return emission * -std::expm1(-r * length) / r;
    return std::isfinite(length) ? emission * length : 0.f;
  };
  return {of(medium.emission.x, rate.x), of(medium.emission.y, rate.y),
          of(medium.emission.z, rate.z)};
}

float sample_bound(float bound, float u) {
  return bound > 0.f ? -std::log1p(-u) / bound : INFINITY;
}

Meeting sample_meeting(const Medium& there, float bound, Vec3 throughput, float u) {
  const Vec3 nothing = Vec3{bound, bound, bound} - (there.absorption + there.scattering);
  const auto amount = [&](Vec3 rate) {
    const Vec3 light = throughput * rate;
    return std::abs(light.x) + std::abs(light.y) + std::abs(light.z);
  };
  const float scattered = amount(there.scattering), passed = amount(nothing);
  if (!(scattered + passed > 0.f)) return {};
  const float chance = scattered / (scattered + passed);
  const bool scatters = u < chance;
  const float probability = scatters ? chance : 1.f - chance;
  return {scatters, (1.f / (bound * probability)) * (scatters ? there.scattering : nothing)};
}

namespace {

/// By how far the cosine is from that of where most light goes: a cosine itself has no digits
/// there.
float phase_density(float narrowness, float apart) {
  const float g = narrowness, rest = 1.f - g;
  const float base = std::max(rest * rest + 2.f * g * apart, 1e-12f);
  return rest * (1.f + g) / (4.f * std::numbers::pi_v<float> * base * std::sqrt(base));
}

}  // namespace

Scattered sample_phase(float anisotropy, Vec3 along, Uniform2 u) {
  const float g = std::abs(anisotropy), rest = 1.f - g;
  const float share = anisotropy < 0.f ? 1.f - u.x : u.x;  // Of what is further from there.
  // 1 - (1 + g^2 - s^2) / (2 g), the division by g divided out.
  const float a = std::max(rest + 2.f * g * share, 1e-12f);
  const float s = rest * (1.f + g) / a;
  const float apart = std::clamp(rest * (1.f - share) * (s + rest) / a, 0.f, 2.f);
  const float sine = std::sqrt(apart * (2.f - apart));
  const float phi = 2.f * std::numbers::pi_v<float> * u.y;
  const Vec3 most = std::copysign(1.f, anisotropy) * along;
  const Vec3 x = perpendicular(along);
  const Vec3 y = cross(along, x);
  return {normalize((1.f - apart) * most + (sine * std::cos(phi)) * x + (sine * std::sin(phi)) * y),
          phase_density(g, apart)};
}

float phase(float anisotropy, Vec3 along, Vec3 to) {
  const Vec3 apart = to - std::copysign(1.f, anisotropy) * along;
  return phase_density(std::abs(anisotropy), 0.5f * dot(apart, apart));
}

}  // namespace nacre::host
