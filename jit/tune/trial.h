#pragma once

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jit/shading/shading_system.h"
#include "jit/tune/kernel_run.h"
#include "runtime/digest.h"

namespace nacre {

/// A material, or outputs of a graph that are one kernel.
struct TuneSubject {
  ShadingSystem* system = nullptr;
  const Document* document = nullptr;
  std::vector<std::string> names;
  bool is_material = false;

  /// For people.
  std::string text() const;
};

/// Points that kernels are run at: those of shading_points(), but for the channels that are given.
struct TunePoints {
  PointSet set;
  Columns given;
};

/// A subject, compiled in one way.
class TuneTrial {
 public:
  /// Null, with diagnostics, where it cannot be, or not as the document says: kernels with another
  /// image than the one asked for have other errors.
  static std::unique_ptr<TuneTrial> compile(const TuneSubject& subject,
                                            const ShaderOptions& options, Diagnostics& diagnostics);

  /// Of all its Programs: trials of the same have the same results.
  const Digest& digest() const { return digest_; }
  /// What a renderer runs where a path meets it, all but the albedo: CountingKernel::cost().
  double cost(const TunePoints& points) const;

  /// What it is: of a material f, albedo, emission, opacity and transmission, and what a medium,
  /// displacement or light is; of an output its channels. Not the densities of directions: they
  /// have no exact values but those that `sample` keeps. Empty where a kernel did not run to its
  /// end, as where the stop of what it was compiled by is due.
  Columns results(const TunePoints& points) const;

  /// Whether that is why there are none.
  bool is_stopped() const { return stop_.is_due(); }

  /// Of its kernels, what a renderer gives of each point.
  std::set<std::string> point_channels() const;

  /// Directions to evaluate a material at: every second of those that it samples, where it does,
  /// the others anywhere on the sphere.
  Columns directions(const TunePoints& points) const;

  /// nanoseconds_a_point() of what cost() counts, so many seconds for each kernel.
  double nanoseconds(const TunePoints& points, double seconds) const;

 private:
  using Named = std::pair<std::string_view, const BoundKernel*>;

  TuneTrial() = default;
  /// Those that there are, `begin` first.
  std::vector<Named> kernels() const;
  /// Runs one after another, which read what `begin` has stored: use(name, kernel, run, given),
  /// where it has been run and `given` holds the state. False where one did not run to its end.
  template <class F>
  bool run_all(const TunePoints& points, F&& use) const;

  std::unique_ptr<MaterialKernels> material_;
  std::unique_ptr<OutputKernel> outputs_;
  Digest digest_{};
  Stop stop_;
};

}  // namespace nacre
