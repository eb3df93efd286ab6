#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "bench/common/benchmarks.h"
#include "bench/textures/image_file.h"
#include "bench/textures/lookups.h"
#include "bench/textures/oiio.h"
#include "bench/textures/ours.h"

namespace nacre::bench {

namespace {

/// The image is of 8 bits and OpenImageIO's levels are, too; each may round the other way.
/// A closest texel may be the next one, which differs by 1 or 2 steps here.
constexpr Tolerance tolerance{.absolute = 1.5 / 255.0, .relative = 0.0, .outliers = 0.001};

/// The image on disk while the program runs.
class TemporaryImage {
 public:
  TemporaryImage() : path_(write_image()) {}
  ~TemporaryImage() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryImage(const TemporaryImage&) = delete;
  TemporaryImage& operator=(const TemporaryImage&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

const std::string& image_path() {
  static const TemporaryImage image;
  return image.path();
}

/// Points and how they are looked up; shared by those that compete.
struct Workload {
  Filter filter;
  bool draws;  ///< One texel a look-up.
  Lookups points;
  Rgba rgba;
  std::unique_ptr<OiioTexture> oiio = nullptr;

  const OiioTexture& other() {
    if (oiio == nullptr) oiio = std::make_unique<OiioTexture>(image_path(), filter);
    return *oiio;
  }
};

Columns columns(const Rgba& rgba) {
  return {{"r", rgba[0]}, {"g", rgba[1]}, {"b", rgba[2]}, {"a", rgba[3]}};
}

/// Batch after batch, all of them over and over.
template <class F>
void measure(benchmark::State& state, const F& look_up) {
  std::size_t batch = 0;
  for (auto _ : state) {
    look_up(batch * batch_points);
    benchmark::ClobberMemory();
    batch = (batch + 1) % lookup_batches;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * batch_points));
}

/// How drawn texels are off on average, beside what chance allows.
class DrawnError {
 public:
  void add(const Rgba& drawn, const Rgba& expected) {
    for (std::size_t i = 0; i < drawn[0].size(); ++i) {
      const double error = double{drawn[0][i]} - double{expected[0][i]};
      sum_ += error, squares_ += error * error, count_ += 1;
    }
  }
  /// Empty, or what is wrong: five standard errors, and half a step of 8 bits, as levels round.
  std::string fault() const {
    const double mean = sum_ / count_;
    const double allowed = 5 * std::sqrt(squares_) / count_ + 0.5 / 255;
    if (std::abs(mean) <= allowed) return {};
    return fmt::format("drawn texels are {} off on average, of {} allowed", mean, allowed);
  }

 private:
  double sum_ = 0, squares_ = 0, count_ = 0;
};

/// Ours against theirs, at all points. Empty, or what differs.
std::string check(Workload& work, const OurTexture& ours) {
  Rgba expected = work.rgba;
  DrawnError drawn;
  for (std::size_t first = 0; first < work.points.u.size(); first += batch_points) {
    ours.look_up(work.points, first, batch_points, work.rgba);
    if (!work.other().look_up(work.points, first, batch_points, expected)) {
      return "OpenImageIO reports an error";
    }
    if (work.draws) {
      drawn.add(work.rgba, expected);
      continue;
    }
    const std::string fault = difference(columns(work.rgba), columns(expected), tolerance);
    if (!fault.empty()) return fault;
  }
  return work.draws ? drawn.fault() : std::string();
}

void register_ours(const std::string& name, const std::shared_ptr<Workload>& work,
                   const Variant& variant) {
  auto ours = std::make_shared<std::unique_ptr<OurTexture>>();
  benchmark::RegisterBenchmark((name + "/" + variant.name()).c_str(), [=](benchmark::State& state) {
    std::string error;
    if (*ours == nullptr) {
      auto made =
          OurTexture::make(image_path(), work->filter, work->draws, variant.options(), error);
      if (made != nullptr) error = check(*work, *made);
      if (error.empty()) *ours = std::move(made);
    }
    if (!error.empty()) {
      state.SkipWithError(error.c_str());
      return;
    }
    measure(state, [&](std::size_t first) {
      (*ours)->look_up(work->points, first, batch_points, work->rgba);
    });
  });
}

void register_workload(const std::string& pattern, Filter filter, bool draws, Lookups points) {
  auto work = std::make_shared<Workload>(Workload{filter, draws, std::move(points), {}});
  for (auto& channel : work->rgba) channel.resize(batch_points);
  const std::string name =
      fmt::format("textures/{}{}/{}", filter_name(filter), draws ? "_drawn" : "", pattern);
  for (const Variant& variant : all_variants()) register_ours(name, work, variant);
  if (draws) return;  // Nothing of OpenImageIO's does that.
  benchmark::RegisterBenchmark((name + "/oiio").c_str(), [=](benchmark::State& state) {
    const OiioTexture& other = work->other();
    for (std::size_t i = 0; i < work->points.u.size(); i += batch_points) {
      other.look_up(work->points, i, batch_points, work->rgba);  // All tiles in its cache.
    }
    measure(state, [&](std::size_t first) {
      other.look_up(work->points, first, batch_points, work->rgba);
    });
  });
}

}  // namespace

void register_benchmarks() {
  if (image_path().empty()) {
    fmt::print(stderr, "cannot write an image to the folder of temporary files\n");
    std::exit(2);
  }
  for (const Filter filter :
       {Filter::closest, Filter::bilinear, Filter::trilinear, Filter::anisotropic}) {
    // Below a texel level 0 alone; 2.8 texels are between two levels.
    const bool is_minified = filter == Filter::trilinear || filter == Filter::anisotropic;
    const float footprint = is_minified ? 2.8f : 0.5f;
    Lookups coherent = coherent_lookups(footprint);
    Lookups random = random_lookups(footprint);
    // A floor seen at about 15 degrees: 7 probes.
    coherent.aspect = random.aspect = filter == Filter::anisotropic ? 4.0f : 1.0f;
    for (const bool draws : {false, true}) {
      if (draws && filter == Filter::closest) continue;
      register_workload("coherent", filter, draws, coherent);
      register_workload("random", filter, draws, random);
    }
  }
}

}  // namespace nacre::bench
