#include "examples/render/pass_film.h"

#include <array>

#include "examples/render/number_bytes.h"

namespace nacre::host {

namespace {

std::vector<std::string> objects_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const Mesh& mesh : scene.meshes) {
    names.push_back(mesh.path.empty() ? mesh.object_name : mesh.path);
  }
  return names;
}

std::vector<std::string> materials_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const Mesh& mesh : scene.meshes) names.push_back(mesh.material_name);
  return names;
}

}  // namespace

PassFilm::PassFilm(const PassRequest& request, const Scene& scene,
                   const std::vector<std::string>& materials, std::size_t pixels) {
  for (const Pass& pass : request.passes) {
    for (const std::string& channel : pass.channels) channels.push_back(pass.name + '.' + channel);
  }
  planes.assign(channels.size(), std::vector<float>(pixels));
  if (request.object_mattes) mattes.emplace_back("CryptoObject", objects_of(scene), pixels);
  if (request.material_mattes) {
    mattes.emplace_back("CryptoMaterial", materials.empty() ? materials_of(scene) : materials,
                        pixels);
  }
}

PassSums::PassSums(const PassRequest& request, const PassFilm& film, std::size_t pixels)
    : request_(request),
      names_(film.mattes),
      channels_(request.channels()),
      sums_(channels_ * pixels),
      hits_(request.any(PassNeed::hit) ? pixels : 0),
      mattes_(film.mattes.size(), std::vector<MattePixel>(pixels)) {}

void PassSums::add(std::size_t pixel, int sample, const PathRecord& record) {
  if (record.hit.is_there) ++hits_[pixel];
  double* to = sums_.data() + pixel * channels_;
  for (const Pass& pass : request_.passes) {
    std::array<float, 4> numbers{};
    const bool counts = pass.mean == Pass::Mean::samples ||
                        (pass.mean == Pass::Mean::first ? sample == 0 : record.hit.is_there);
    if (counts) pass.read(record, pass.which, numbers.data());
    for (std::size_t k = 0; k < pass.channels.size(); ++k) {
      *to++ += static_cast<double>(numbers[k]);
    }
  }
  if (!record.hit.is_there) return;
  for (std::size_t k = 0; k < mattes_.size(); ++k) {
    mattes_[k][pixel].add(names_[k].of_mesh[record.hit.mesh]);
  }
}

void PassSums::store(std::size_t pixel, int samples, PassFilm& film, std::size_t film_pixel) const {
  std::size_t channel = 0;
  for (const Pass& pass : request_.passes) {
    const double count = pass.mean == Pass::Mean::samples ? samples
                         : pass.mean == Pass::Mean::hits  ? hits_[pixel]
                                                          : 1.0;
    for (std::size_t k = 0; k < pass.channels.size(); ++k, ++channel) {
      const double sum = sums_[pixel * channels_ + channel];
      film.planes[channel][film_pixel] = static_cast<float>(count > 0 ? sum / count : 0.0);
    }
  }
  for (std::size_t k = 0; k < mattes_.size(); ++k) {
    Mattes& mattes = film.mattes[k];
    std::size_t plane = 0;
    for (const MattePixel::Count& each : mattes_[k][pixel].ranked(Mattes::ranks)) {
      mattes.planes[plane++][film_pixel] = mattes.ids[each.name];
      mattes.planes[plane++][film_pixel] =
          static_cast<float>(each.samples) / static_cast<float>(samples);
    }
  }
}

void PassSums::append_to(std::string& bytes) const {
  append_numbers(bytes, sums_);
  append_numbers(bytes, hits_);
  for (const std::vector<MattePixel>& mattes : mattes_) {
    for (const MattePixel& pixel : mattes) {
      append_numbers(bytes, std::vector{static_cast<std::uint32_t>(pixel.counts.size())});
      append_numbers(bytes, pixel.counts);
    }
  }
}

bool PassSums::assign(std::string_view bytes) {
  if (!take_numbers(bytes, sums_) || !take_numbers(bytes, hits_)) return false;
  for (std::vector<MattePixel>& mattes : mattes_) {
    for (MattePixel& pixel : mattes) {
      std::vector<std::uint32_t> count(1);
      if (!take_numbers(bytes, count)) return false;
      if (count[0] > bytes.size() / sizeof(MattePixel::Count)) return false;
      pixel.counts.resize(count[0]);
      if (!take_numbers(bytes, pixel.counts)) return false;
    }
  }
  return bytes.empty();
}

}  // namespace nacre::host
