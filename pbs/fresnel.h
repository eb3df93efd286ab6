#pragma once

#include "runtime/value/vector.h"

namespace nacre {

/// Unpolarised reflectances of smooth interfaces. Cosines are of the angle
/// between ray and normal, in [0, 1]; results are in [0, 1] for any bits of the
/// other arguments. `eta` is the index beyond the interface over the one before
/// it.

/// Reflectance of the two polarisations: electric field perpendicular (s) and
/// parallel (p) to the plane of incidence.
struct Polarised {
  Float s, p;
  Float mean() const { return 0.5f * (s + p); }
};
struct Polarised3 {
  Color3 s, p;
};

/// Born and Wolf, "Principles of Optics" (7th ed.), 1.5.2, with the numerators
/// factored so that eta near 1 keeps its digits: 0 at eta = 1, 1 at grazing and
/// under total reflection. eta in [0.02, 50].
Polarised fresnel_dielectric_polarised(Float cosine, Float eta);
Float fresnel_dielectric(Float cosine, Float eta);

/// Whether a ray is totally reflected; decides as fresnel_dielectric does.
Bool totally_reflected(Float cosine, Float eta);

/// Metals: complex index n + ik relative to the medium before. n, k in [0, 1e4].
Polarised fresnel_conductor_polarised(Float cosine, Float n, Float k);
Color3 fresnel_conductor(Float cosine, Color3 n, Color3 k);

/// Schlick's curve between two colours with free exponent, less a term that
/// makes the reflectance at acos(1/7), about 82 degrees, color82 times what the
/// curve alone gives there. Hoffman, "Generalization of Adobe's Fresnel Model", 2023.
class SchlickCurve {
 public:
  SchlickCurve() = default;
  /// Colours are clamped to [0, 1], the exponent to [0, 1000].
  SchlickCurve(Color3 color0, Color3 color82, Color3 color90, Float exponent);

  Color3 at(Float cosine) const;
  /// Twice the integral of F(c) c over c: the reflectance of diffuse light.
  Color3 mean() const;

  Color3 color0, color90;
  Color3 dip;  ///< Factor of c (1 - c)^6.
  Float exponent = 5.0f;
};

/// ((eta - 1) / (eta + 1))^2 and its inverse for eta >= 1; reflectance clamped to
/// [0.01, most] there, by default as the data library's own.
Float reflectance_of_index(Float eta);
Float index_of_reflectance(Float reflectance, float most = 0.99f);

}  // namespace nacre
