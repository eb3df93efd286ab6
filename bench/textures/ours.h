#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/textures/lookups.h"
#include "jit/compile/compile.h"
#include "jit/shading/bound_kernel.h"

namespace nacre::bench {

/// An image node's look-up as a kernel of its own. The texture is resident. `bilinear` and
/// `trilinear` are one kernel: the footprint decides.
class OurTexture {
 public:
  /// Null, with the reason, where it can't be compiled. `draws`: one of the filter's texels.
  static std::unique_ptr<OurTexture> make(const std::string& path, Filter filter, bool draws,
                                          const CompileOptions& options, std::string& error);

  void look_up(const Lookups& points, std::size_t first, std::size_t count, Rgba& rgba) const;

 private:
  explicit OurTexture(BoundKernel kernel) : kernel_(std::move(kernel)) {}
  const float* channel(const std::string& name, const Lookups& points, std::size_t first) const;

  BoundKernel kernel_;
  mutable std::vector<float> long_axis_, footprint_, zero_;
};

}  // namespace nacre::bench
