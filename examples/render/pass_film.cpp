#include "examples/render/pass_film.h"

#include <array>
#include <cstring>
#include <map>

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

template <class T>
void append(std::string& bytes, const std::vector<T>& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}

/// Takes as many as there are from the front. False where there are not.
template <class T>
bool take(std::string_view& bytes, std::vector<T>& numbers) {
  const std::size_t size = numbers.size() * sizeof(T);
  if (bytes.size() < size) return false;
  std::memcpy(numbers.data(), bytes.data(), size);
  bytes.remove_prefix(size);
  return true;
}

}  // namespace

MatteNames::MatteNames(const std::vector<std::string>& of_meshes) {
  std::map<std::string, std::uint32_t> known;
  for (const std::string& name : of_meshes) {
    const auto [at, is_new] = known.emplace(name, static_cast<std::uint32_t>(names.size()));
    if (is_new) names.push_back(name);
    of_mesh.push_back(at->second);
  }
}

PassFilm::PassFilm(const PassRequest& request, const Scene& scene,
                   const std::vector<std::string>& materials, int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const Pass& pass : request.passes) {
    for (const std::string& channel : pass.channels) channels.push_back(pass.name + '.' + channel);
  }
  planes.assign(channels.size(), std::vector<float>(pixels));
  const auto add = [&](const char* type, const std::vector<std::string>& names) {
    matte_names.emplace_back(names);
    mattes.push_back({type, matte_names.back().names,
                      std::vector(2 * Mattes::ranks, std::vector<float>(pixels))});
  };
  if (request.object_mattes) add("CryptoObject", objects_of(scene));
  if (request.material_mattes) {
    add("CryptoMaterial", materials.empty() ? materials_of(scene) : materials);
  }
}

PassSums::PassSums(const PassRequest& request, const PassFilm& film, std::size_t pixels)
    : request_(request),
      names_(film.matte_names),
      channels_(request.channels()),
      sums_(channels_ * pixels),
      samples_(pixels),
      hits_(pixels),
      mattes_(film.mattes.size(), std::vector<MattePixel>(pixels)) {}

void PassSums::add(std::size_t pixel, const PathRecord& record) {
  const bool is_first = samples_[pixel]++ == 0;
  if (record.hit.is_there) ++hits_[pixel];
  double* to = sums_.data() + pixel * channels_;
  for (const Pass& pass : request_.passes) {
    std::array<float, 4> numbers{};
    const bool counts = pass.mean == Pass::Mean::samples ||
                        (pass.mean == Pass::Mean::first ? is_first : record.hit.is_there);
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

void PassSums::store(std::size_t pixel, std::size_t to, PassFilm& film) const {
  std::size_t channel = 0;
  for (const Pass& pass : request_.passes) {
    const double count = pass.mean == Pass::Mean::samples ? samples_[pixel]
                         : pass.mean == Pass::Mean::hits  ? hits_[pixel]
                                                          : 1.0;
    for (std::size_t k = 0; k < pass.channels.size(); ++k, ++channel) {
      const double sum = sums_[pixel * channels_ + channel];
      film.planes[channel][to] = static_cast<float>(count > 0 ? sum / count : 0.0);
    }
  }
  for (std::size_t k = 0; k < mattes_.size(); ++k) {
    Mattes& mattes = film.mattes[k];
    const auto ranked = mattes_[k][pixel].ranked(samples_[pixel]);
    for (std::size_t rank = 0; rank < ranked.size() && rank < Mattes::ranks; ++rank) {
      mattes.planes[2 * rank][to] = matte_id(matte_hash(mattes.names[ranked[rank].first]));
      mattes.planes[2 * rank + 1][to] = ranked[rank].second;
    }
  }
}

void PassSums::append_to(std::string& bytes) const {
  append(bytes, sums_);
  append(bytes, samples_);
  append(bytes, hits_);
  for (const std::vector<MattePixel>& mattes : mattes_) {
    for (const MattePixel& pixel : mattes) {
      append(bytes, std::vector{static_cast<std::uint32_t>(pixel.counts.size())});
      append(bytes, pixel.counts);
    }
  }
}

bool PassSums::assign(std::string_view bytes) {
  if (!take(bytes, sums_) || !take(bytes, samples_) || !take(bytes, hits_)) return false;
  for (std::vector<MattePixel>& mattes : mattes_) {
    for (MattePixel& pixel : mattes) {
      std::vector<std::uint32_t> count(1);
      if (!take(bytes, count) || count[0] > bytes.size() / sizeof(pixel.counts[0])) return false;
      pixel.counts.resize(count[0]);
      if (!take(bytes, pixel.counts)) return false;
    }
  }
  return bytes.empty();
}

}  // namespace nacre::host
