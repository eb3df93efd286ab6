#include "tests/pbs/battery/closure_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string_view>

namespace nacre {

namespace {

/// A number of each point.
template <class T>
class Column {
 public:
  explicit Column(const std::vector<std::uint32_t>& words) : words_(words.data()) {}

  T operator[](std::size_t i) const { return std::bit_cast<T>(words_[i]); }

 private:
  const std::uint32_t* words_;
};

/// A vector or colour of each point.
struct Columns {
  Column<float> x, y, z;

  float largest(std::size_t i) const { return std::max({x[i], y[i], z[i]}); }
};

double dot(const Columns& a, const Columns& b, std::size_t i) {
  return double(a.x[i]) * double(b.x[i]) + double(a.y[i]) * double(b.y[i]) +
         double(a.z[i]) * double(b.z[i]);
}

/// As a kernel takes it.
bool is_unit(const Columns& w, std::size_t i) { return std::abs(dot(w, w, i) - 1.0) < 0.9e-3; }

Column<float> numbers(const Arrays& arrays, std::string_view name) {
  return Column<float>(arrays.find(name)->second);
}

Column<std::int32_t> wholes(const Arrays& arrays, std::string_view name) {
  return Column<std::int32_t>(arrays.find(name)->second);
}

Columns vectors(const Arrays& arrays, const std::string& name) {
  return {numbers(arrays, name + ".x"), numbers(arrays, name + ".y"), numbers(arrays, name + ".z")};
}

constexpr float largest = 3.4028235e38f;

bool sane(float x) { return x >= 0.0f && x <= largest; }
bool is_finite(float x) { return std::abs(x) <= largest; }
bool is_share(float x) { return x >= 0.0f && x <= 1.0f; }
bool is_cosine(float x) { return x >= -1.0f && x <= 1.0f; }

/// Relative to the larger, beside what denormals lose, which count as 0.
bool agree(double a, double b, double error, double lost) {
  return std::abs(a - b) <= error * std::max(std::abs(a), std::abs(b)) + lost;
}

constexpr double smallest = 0x1p-126;

class Trial {
 public:
  Trial(const ClosureKernels& kernels, const Arrays& points, std::size_t count)
      : kernels_(kernels), in_(points), count_(count) {}

  std::vector<ClosureFault> run() {
    if (kernels_.material) try_material(*kernels_.material);
    if (kernels_.values) try_channels(run(kernels_.values->kernel));
    return std::move(faults_);
  }

 private:
  /// `text`: says what was found; called only where the law does not hold.
  template <class Text>
  void expect(bool holds, std::string_view law, std::size_t i, Text&& text) {
    if (holds) return;
    const auto known =
        std::ranges::find_if(faults_, [&](const ClosureFault& each) { return each.law == law; });
    if (known != faults_.end()) {
      ++known->count;
    } else {
      faults_.push_back({std::string(law), 1, i, text()});
    }
  }

  void expect_all(const Arrays& results, std::string_view prefix, bool (*holds)(float),
                  std::string_view law) {
    for (const auto& [name, column] : results) {
      if (name != prefix && !name.starts_with(std::string(prefix) + ".")) continue;
      for (std::size_t i = 0; i < count_; ++i) {
        const float x = std::bit_cast<float>(column[i]);
        expect(holds(x), law, i, [&] { return fmt::format("{} = {}", name, x); });
      }
    }
  }

  void expect_unit(const Arrays& results, const std::string& name, bool zero_too,
                   std::string_view law) {
    if (!results.contains(name + ".x")) return;
    const Columns v = vectors(results, name);
    for (std::size_t i = 0; i < count_; ++i) {
      const double length2 = dot(v, v, i);
      expect(std::abs(length2 - 1.0) <= 2e-5 || (zero_too && length2 == 0.0), law, i,
             [&] { return fmt::format("{} = ({}, {}, {})", name, v.x[i], v.y[i], v.z[i]); });
    }
  }

  Arrays run(const BoundKernel& kernel) { return nacre::run(kernel, in_, count_); }

  /// What a kernel found is what the next ones are given.
  void pass_on(const Arrays& results, const std::string& name, const std::string& as) {
    for (const char* k : {".x", ".y", ".z"}) in_[as + k] = results.find(name + k)->second;
  }

  void try_material(const MaterialKernels& material) {
    if (material.begin) {
      const Arrays begun = run(*material.begin);
      for (const auto& [name, column] : begun) in_[name] = column;
      expect_unit(begun, "normal", false, "the mean normal is unit");
      expect_all(begun, "roughness", is_share, "roughness is in [0, 1]");
    }
    if (material.evaluate) try_evaluate(run(*material.evaluate));
    if (material.sample) try_sample(material, run(*material.sample));
    for (const auto* kernel :
         {&material.albedo, &material.opacity, &material.shadow, &material.interior}) {
      if (*kernel) try_channels(run(**kernel));
    }
    if (material.emission) try_emission(run(*material.emission));
    if (material.emit) try_emit(material, run(*material.emit));
    if (material.subsurface) try_channels(run(*material.subsurface));
  }

  void try_evaluate(const Arrays& e) {
    expect_all(e, "f", sane, "f is finite and not negative");
    expect_all(e, "pdf", sane, "pdf is finite and not negative");
    expect_all(e, "pdf_reverse", sane, "pdf_reverse is finite and not negative");
    const Columns f = vectors(e, "f");
    const Column<float> pdf = numbers(e, "pdf");
    for (std::size_t i = 0; i < count_; ++i) {
      const float light = f.largest(i);
      expect(!(light > 0.0f) || pdf[i] > 0.0f, "f > 0 needs pdf > 0", i,
             [&] { return fmt::format("f = {}, pdf = {}", light, pdf[i]); });
    }
  }

  void try_sample(const MaterialKernels& material, const Arrays& s) {
    expect_all(s, "weight", sane, "weight is finite and not negative");
    expect_all(s, "pdf", sane, "a sample's pdf is finite and not negative");
    expect_all(s, "pdf_reverse", sane, "a sample's pdf_reverse is finite and not negative");
    try_directions(material, s);
    pass_on(s, "wi", "wi");
    in_["of_lobe"] = s.find("lobe")->second;
    if (material.evaluate) compare(s, run(*material.evaluate));
  }

  void try_directions(const MaterialKernels& material, const Arrays& s) {
    const Columns wi = vectors(s, "wi"), weight = vectors(s, "weight");
    const Column<float> pdf = numbers(s, "pdf");
    const Column<std::int32_t> flags = wholes(s, "flags"), lobe = wholes(s, "lobe");
    const auto lobes = static_cast<std::int32_t>(material.lobes.size());
    for (std::size_t i = 0; i < count_; ++i) {
      if ((flags[i] & sample_valid) == 0) {
        const float light = weight.largest(i);
        expect(light == 0.0f && pdf[i] == 0.0f, "a lost sample has no light", i,
               [&] { return fmt::format("weight = {}, pdf = {}", light, pdf[i]); });
        continue;
      }
      expect(pdf[i] > 0.0f, "a valid sample has a pdf", i,
             [&] { return fmt::format("pdf = {}", pdf[i]); });
      expect(std::abs(dot(wi, wi, i) - 1.0) <= 2e-5, "wi is unit", i,
             [&] { return fmt::format("wi = ({}, {}, {})", wi.x[i], wi.y[i], wi.z[i]); });
      expect(lobe[i] >= 0 && lobe[i] < lobes, "a sample's lobe exists", i,
             [&] { return fmt::format("lobe {} of {}", lobe[i], lobes); });
    }
  }

  void compare(const Arrays& s, const Arrays& e) {
    const Columns weight = vectors(s, "weight"), f = vectors(e, "f");
    const Column<float> pdf = numbers(s, "pdf"), again = numbers(e, "pdf");
    const Column<std::int32_t> flags = wholes(s, "flags");
    for (std::size_t i = 0; i < count_; ++i) {
      if ((flags[i] & sample_valid) == 0 || (flags[i] & sample_delta) != 0) continue;
      // For `fast` LLVM may order sums as it likes, in two kernels differently.
      expect(is_fast() ? agree(pdf[i], again[i], 1e-4, smallest) : pdf[i] == again[i],
             "evaluate has the sample's pdf", i,
             [&] { return fmt::format("sample {}, evaluate {}", pdf[i], again[i]); });
      for (const auto part : {&Columns::x, &Columns::y, &Columns::z}) {
        const double w = (weight.*part)[i], p = pdf[i], found = (f.*part)[i];
        expect(agree(w * p, found, 1e-4, smallest * std::max(1.0, p)), "weight pdf is f", i,
               [&] { return fmt::format("weight {} pdf {} = {}, f {}", w, p, w * p, found); });
      }
    }
  }

  void try_emission(const Arrays& r) {
    expect_all(r, "emission", sane, "emission is finite and not negative");
    expect_all(r, "pdf", sane, "the pdf of emission is finite and not negative");
    const Columns emission = vectors(r, "emission"), wo = vectors(in_, "wo"),
                  ng = vectors(in_, "Ng");
    const Column<float> pdf = numbers(r, "pdf");
    for (std::size_t i = 0; i < count_; ++i) {
      const float light = emission.largest(i);
      // What the rounding of a cosine is larger than carries no light.
      const bool leaves = light > 0.0f && is_unit(wo, i) && std::abs(dot(wo, ng, i)) > 1e-6;
      expect(!leaves || pdf[i] > 0.0f, "emission needs a pdf", i,
             [&] { return fmt::format("emission = {}, pdf = {}", light, pdf[i]); });
    }
  }

  /// Changes wo.
  void try_emit(const MaterialKernels& material, const Arrays& s) {
    expect_unit(s, "emitted", false, "emitted is unit");
    expect_all(s, "weight", sane, "the weight of emitted light is finite and not negative");
    expect_all(s, "pdf", sane, "the pdf of emitted light is finite and not negative");
    pass_on(s, "emitted", "wo");
    const Columns weight = vectors(s, "weight");
    const Column<float> pdf = numbers(s, "pdf");
    for (std::size_t i = 0; i < count_; ++i) {
      const float light = weight.largest(i);
      expect(pdf[i] > 0.0f || light == 0.0f, "emitted light has a pdf", i,
             [&] { return fmt::format("weight = {}, pdf = {}", light, pdf[i]); });
    }
    compare_emitted(s, run(*material.emission));
  }

  void compare_emitted(const Arrays& s, const Arrays& e) {
    const Columns weight = vectors(s, "weight"), emission = vectors(e, "emission");
    const Columns wo = vectors(in_, "wo"), ng = vectors(in_, "Ng");
    const Column<float> pdf = numbers(s, "pdf"), again = numbers(e, "pdf");
    for (std::size_t i = 0; i < count_; ++i) {
      if (!(pdf[i] > 0.0f)) continue;
      expect(is_fast() ? agree(pdf[i], again[i], 1e-3, smallest) : pdf[i] == again[i],
             "emission has the pdf of emitted light", i,
             [&] { return fmt::format("emit {}, emission {}", pdf[i], again[i]); });
      const double cosine = std::abs(dot(wo, ng, i)), p = pdf[i];
      for (const auto part : {&Columns::x, &Columns::y, &Columns::z}) {
        const double w = (weight.*part)[i], radiance = (emission.*part)[i];
        // A cosine of floats has so many digits.
        const double lost = 1e-6 * radiance + smallest * std::max(1.0, p);
        expect(w == largest || agree(w * p, radiance * cosine, 1e-3, lost),
               "weight pdf is emission cos", i, [&] {
                 return fmt::format("weight {} pdf {} = {}, emission cos {}", w, p, w * p,
                                    radiance * cosine);
               });
      }
    }
  }

  /// What other entries give, by name.
  void try_channels(const Arrays& r) {
    for (const char* name : {"albedo", "opacity", "presence", "opacity_color"}) {
      expect_all(r, name, is_share, std::string(name) + " is in [0, 1]");
    }
    for (const char* name : {"transmission", "absorption", "scattering", "eta", "out.emission",
                             "out.absorption", "out.scattering", "out.distance"}) {
      expect_all(r, name, sane, std::string(name) + " is finite and not negative");
    }
    expect_all(r, "eta", [](float x) { return x > 0.0f; }, "eta is positive");
    for (const char* name : {"anisotropy", "out.anisotropy"}) {
      expect_all(r, name, is_cosine, "anisotropy is in [-1, 1]");
    }
    expect_unit(r, "normal", false, "the normal below is unit");
    for (const char* name : {"out.intensity", "out.direction"}) {
      expect_all(r, name, is_finite, std::string(name) + " is finite");
    }
    // Of one infinitely far away it is the document's.
    if (r.contains("out.distance")) {
      expect_unit(r, "out.direction", true, "the direction to a light is unit");
    }
    for (const auto& [name, column] : r) is_known(name);
  }

  void is_known(const std::string& name) {
    static const std::string known[] = {"albedo",    "opacity",      "presence",   "opacity_color",
                                        "emission",  "transmission", "absorption", "scattering",
                                        "intensity", "eta",          "anisotropy", "normal",
                                        "direction", "distance",     "offset"};
    const std::string bare = name.starts_with("out.") ? name.substr(4) : name;
    const std::string group = bare.substr(0, bare.find('.'));
    expect(std::ranges::find(known, group) != std::end(known), "every result has a law", 0,
           [&] { return name; });
  }

  bool is_fast() const { return kernels_.way.accuracy == Accuracy::fast; }

  const ClosureKernels& kernels_;
  Arrays in_;
  std::size_t count_;
  std::vector<ClosureFault> faults_;
};

}  // namespace

std::vector<ClosureFault> try_laws(const ClosureKernels& kernels, const Arrays& points,
                                   std::size_t count) {
  return Trial(kernels, points, count).run();
}

}  // namespace nacre
