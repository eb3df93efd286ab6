#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "runtime/program/program.h"
#include "runtime/program/recorder.h"
#include "runtime/value/vector.h"

namespace nacre {

/// What the kernels of a surface leave out, a line for each thing.
class LeftOut {
 public:
  /// Each line once.
  void add(const std::string& line) {
    if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
  }
  /// In the order they came.
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

class Vdf;

/// A medium behind an interface, and how much is seen of that interface.
struct SeenMedium {
  std::shared_ptr<const Vdf> medium;  ///< Never null.
  Color3 weight;
};

/// One thing of each side of a surface: of what comes back, and of what passes.
struct BySide {
  Bool reflection = true;
  Bool transmission = true;
};

/// Whose light lobes of facets scale up for what several scatterings between facets bring back,
/// which their formulas leave out.
enum class Compensation {
  all,         ///< What does not absorb returns all light.
  reflection,  ///< But for what transmits: rough glass is darker.
  nothing,     ///< Rough metals are darker, too: as many renderers have them.
};

/// From where a closure is looked at, while recording.
struct View {
  Recorder* recorder = nullptr;            ///< Where closures record; never null.
  Accuracy accuracy = Accuracy::standard;  ///< What closures aim at.
  Float3 wo;                               ///< Unit, world space, from the point to the viewer.
  Bool thin_walled = false;                ///< Light that enters leaves at the same point.
  Compensation compensation = Compensation::all;
  /// How far off what depends on the view alone may be, as a share of it, where that makes a table
  /// of it; 0: nothing is tabulated.
  double table_error = 0;
  /// Light that enters below the surface is the host's to follow (SurfaceKernels::subsurface); else
  /// it leaves where it enters.
  bool follows_subsurface = false;
  /// Which sides a lobe that has both shall scatter to: `sample` chooses of those. A lobe that pays
  /// no heed to it loses samples.
  BySide wanted = {};
  /// Where closures put down what of them the kernels leave out though it would change the
  /// picture; null: nowhere.
  LeftOut* left_out = nullptr;
  /// Where `flatten` puts down the media that interfaces enclose; null: nowhere.
  std::vector<SeenMedium>* media = nullptr;
  /// And where `flatten` puts down lobes that nothing is seen of; null: nowhere.
  LeftOut* unseen = nullptr;
};

/// A local frame: x and y tangents, z the normal; unit and orthogonal.
struct Frame {
  /// World space.
  /// @{
  Float3 x, y, z;
  /// @}
  /// A vector of world space by its components along x, y and z.
  Float3 to_local(Float3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  /// The inverse.
  Float3 to_world(Float3 v) const {
    return fma(Float3(v.x), x, fma(Float3(v.y), y, Float3(v.z) * z));
  }
};

/// Any frame around a unit normal. Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), 2017: deviation below 2e-7 everywhere.
Frame make_frame(Float3 normal);

/// The frame whose x is the tangent made orthogonal to the normal; make_frame
/// where the tangent is zero or along the normal.
Frame make_frame(Float3 normal, Float3 tangent);

/// The normal on the viewer's side: n or -n.
Float3 facing(Float3 n, Float3 wo);
/// make_frame(n), but for z, which is on the viewer's side: what lobes of one normal share.
Frame facing_frame(Float3 n, Float3 wo);
/// Its cosine to the view, in [0, 1].
Float facing_cosine(Float3 n, Float3 wo);

/// x y, but nothing where either is a literal zero: a weight that is off leaves out what
/// it weighs, and what is black stays so behind anything, infinities included.
Color3 product(Color3 x, Color3 y);

/// Emitted light, whatever numbers it was computed of: NaN is 0, and what is beyond the largest
/// float is that.
Color3 finite_light(Color3 light);

/// Keeps a value for the kernels after `begin`; see Recorder::keep. A value
/// that is an input channel itself is read again instead.
/// @{
Float keep(Recorder& recorder, Float x);
Int keep(Recorder& recorder, Int x);
Bool keep(Recorder& recorder, Bool x);
Float2 keep(Recorder& recorder, Float2 v);
Float3 keep(Recorder& recorder, Float3 v);
/// @}

}  // namespace nacre
