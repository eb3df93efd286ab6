#pragma once

#include "examples/render/sampler.h"
#include "examples/render/scene.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// Of a vertical field of view, radians: what a float can still tell from 0 and pi.
inline constexpr float smallest_fov = 1e-5f, largest_fov = 3.14f;

/// Whether rays can be made of a camera: finite directions, a field of view within these
/// bounds, and lengths of at most largest_coordinate (the focus more than 0). An error
/// for each that is not so.
bool check_camera(const Camera& camera, Diagnostics& diagnostics);

/// A camera at `position` that sees `target` in the middle, +y up, with a
/// vertical field of view in radians. In focus at the target.
Camera look_at(Vec3 position, Vec3 target, float vertical_fov);

/// Stands a camera where `world` takes one at 0 that looks along -z with +y up, as the shutter
/// opens, and says how it moves from there. False where it looks nowhere.
bool place_camera(const Motion& world, Camera& camera, Motion& motion);

/// A three-quarter view (from the right, a little above) whose bounding sphere
/// fits the image. `aspect` is width / height.
Camera fit_camera(const Bounds& box, float aspect);

/// A camera set up for an image: what depends on its size is computed once.
class PixelCamera {
 public:
  struct Ray {
    Vec3 origin;
    Vec3 direction;  ///< Unit length.
  };

  /// `sample_spacing`: distance of image samples in pixels, which scales footprints.
  /// `motion` takes the camera from where it stands to where it is: rigid, but for the chords
  /// of what turns.
  PixelCamera(const Camera& camera, int width, int height, float sample_spacing,
              const Motion& motion = {});

  /// The ray through image position (x, y), in pixels from the upper left corner.
  Ray ray(float x, float y, Uniform2 lens, float time = 0.f) const;

  /// Whether rays depend on where on the lens they begin.
  bool has_lens() const { return camera_.lens_radius > 0.f; }

  /// How far P moves, on the plane through P with unit normal n, when the image
  /// position moves by one sample: Igehy 1999, "Tracing Ray Differentials",
  /// sections 3.1.1 and 3.1.2, for a straight ray of this direction and length.
  void footprint(Vec3 direction, float distance, Vec3 n, float time, Vec3& dPdx, Vec3& dPdy) const;

  /// Distance of P along the camera's axis.
  float depth(Vec3 P, float time) const;

  /// Image position that the middle of the lens sees P at, pixels from the upper left corner; for
  /// what is in front of it.
  Vec2 place(Vec3 P, float time) const;

  /// Whether anything of a ball may be in the picture, or next to it; true where the camera moves
  /// or has a lens.
  bool may_see(Vec3 centre, float radius) const;

  /// Angle between neighbouring samples in the middle of the image, radians.
  float sample_angle() const { return angle_; }

 private:
  /// The way to P from where the camera stands, before it moves.
  Vec3 from_camera(Vec3 P, float time) const;
  Ray standing_ray(float x, float y, Uniform2 lens) const;
  void standing_footprint(Vec3 direction, float distance, Vec3 n, Vec3& dPdx, Vec3& dPdy) const;

  Camera camera_;
  Motion motion_;
  Vec3 corner_;           ///< From the lens centre to the upper left of the focal plane.
  Vec3 step_x_, step_y_;  ///< One pixel on the focal plane.
  float spacing_;
  float angle_;
};

}  // namespace nacre::host
