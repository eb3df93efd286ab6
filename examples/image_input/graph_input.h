#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

#include "examples/image_input/opened_graph.h"

namespace graph_image {

/// A graph output as a tiled texture of OpenImageIO's, whose texels are computed when they are
/// read. Once it is open, any number of threads may read.
class GraphInput final : public OIIO::ImageInput {
 public:
  /// `open_graph` is called by open() alone: making a reader costs nothing.
  explicit GraphInput(OpenGraph* open_graph) : open_graph_(open_graph) {}

  const char* format_name() const override { return "mtlx"; }
  /// Not "procedural", though names with a query are no files: oiiotool 2.4 would end by a fault
  /// where one cannot be opened, and text files would not be looked for in a search path.
  int supports(OIIO::string_view feature) const override;
  bool valid_file(const std::string& name) const override;
  bool open(const std::string& name, OIIO::ImageSpec& spec) override;
  bool open(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override;
  bool close() override;

  int current_miplevel() const override { return level_; }
  bool seek_subimage(int subimage, int level) override;
  OIIO::ImageSpec spec(int subimage, int level) override;
  OIIO::ImageSpec spec_dimensions(int subimage, int level) override;
  using OIIO::ImageInput::spec;

  bool read_native_scanline(int subimage, int level, int y, int z, void* data) override;
  bool read_native_tile(int subimage, int level, int x, int y, int z, void* data) override;
  bool read_native_tiles(int subimage, int level, int left, int right, int top, int bottom,
                         int front, int back, void* data) override;
  using OIIO::ImageInput::read_native_tiles;

 private:
  bool open_with(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec* config);
  bool has_level(int subimage, int level) const;
  /// As samples of the file's type, `row_texels` from one row to the next. False, with what is to
  /// be said, where that fails.
  bool shade(int level, const Texels& texels, int row_texels, void* data, std::string& problem);
  /// Those of a tile that are in the image.
  Texels tile_at(int level, int x, int y) const;

  OpenGraph* open_graph_;
  std::unique_ptr<const OpenedGraph> graph_;
  Request request_;
  int levels_ = 0;
  int level_ = 0;  ///< That m_spec is of.
};

}  // namespace graph_image
