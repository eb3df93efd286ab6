#pragma once

#include <cstdint>
#include <vector>

#include "examples/render/cryptomatte.h"
#include "examples/render/passes.h"
#include "examples/render/scene.h"

namespace nacre::host {

/// Images beside the picture: rows from the top.
class PassFilm {
 public:
  PassFilm() = default;
  /// `materials`: what shades each mesh of the scene; empty: as the meshes say.
  PassFilm(const PassRequest& request, const Scene& scene,
           const std::vector<std::string>& materials, std::size_t pixels);

  bool empty() const { return planes.empty() && mattes.empty(); }

  std::vector<std::string> channels;       ///< "direct_diffuse.R", …
  std::vector<std::vector<float>> planes;  ///< One for each.
  std::vector<Mattes> mattes;
};

/// All samples of an image.
class PassSums {
 public:
  PassSums(const PassRequest& request, const PassFilm& film, std::size_t pixels);
  /// Sample number `sample`, from 0, of a pixel.
  void add(std::size_t pixel, int sample, const PathRecord& record);
  /// Puts a pixel that has so many samples into that of the film.
  void store(std::size_t pixel, int samples, PassFilm& film, std::size_t film_pixel) const;

  /// All of it, for a file; and back: false where it is of another image.
  void append_to(std::string& bytes) const;
  bool assign(std::string_view bytes);

 private:
  const PassRequest& request_;
  const std::vector<Mattes>& names_;
  std::size_t channels_;
  std::vector<double> sums_;                     ///< By pixel, all channels together.
  std::vector<std::uint32_t> hits_;              ///< By pixel, where anything asks what was hit.
  std::vector<std::vector<MattePixel>> mattes_;  ///< By set, by pixel.
};

}  // namespace nacre::host
