#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "examples/bake_mesh/mesh_surface.h"
#include "examples/render/batch_buffer.h"
#include "examples/render/batch_channels.h"
#include "examples/render/camera.h"
#include "examples/render/surface.h"

namespace nacre::host {

/// What one thread bakes a MeshSurface with.
class MeshPoints : public SurfacePoints {
 public:
  MeshPoints(const MeshSurface& surface, std::shared_ptr<const RowIndex> rows,
             const Program& program, bool in_frame);

  void enter(int first, int rows) override { cover_.enter(first, rows); }
  bool covers(std::size_t texel) const override { return cover_.covers(texel); }
  std::span<const std::uint8_t> place(const TexelPoints& points) override;
  void fill(std::string_view channel, const TexelPoints& points,
            std::vector<float>& values) const override;
  bool is_constant(std::string_view) const override { return false; }
  void turn_into_frame(const std::array<std::span<float>, 3>& vectors) const override;

 private:
  /// Values of all points, of one channel.
  using Filler = std::function<void(float footprint, std::vector<float>& values)>;

  Filler filler_of(const std::string& channel);
  Filler derivative_of(std::string_view group, int component, int axis);
  Filler transport_of(std::string_view property, int component);
  bool has_attribute(std::string_view property) const;
  void trace();
  TransportPoint transport_point(std::size_t i) const;
  Vec3 position_change(const SurfacePoint& point, FlatWeights change, bool in_object) const;

  const MeshSurface& surface_;
  std::shared_ptr<const RowIndex> rows_;
  TexelCover cover_;
  SurfaceGeometry geometry_;
  PixelCamera camera_;  ///< For the geometry; nothing is asked of it.
  Capabilities needs_;
  std::map<std::string, Filler, std::less<>> fillers_;
  bool wants_openness_ = false, wants_thickness_ = false;

  // Of the points last placed.
  std::unique_ptr<BatchBuffer> buffer_;
  std::vector<SurfacePoint> points_;
  std::vector<std::uint8_t> is_inside_;
  std::vector<FlatWeights> along_x_, along_y_;  ///< Change from texel to texel.
  std::vector<std::uint32_t> seeds_;
  std::vector<Openness> openness_;
  std::vector<float> thickness_;
};

}  // namespace nacre::host
