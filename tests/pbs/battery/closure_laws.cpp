#include "tests/pbs/battery/closure_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string_view>

namespace nacre {

namespace {

/// A kernel's outputs as numbers.
class Results {
 public:
  explicit Results(Arrays arrays) : arrays_(std::move(arrays)) {}

  bool has(std::string_view name) const { return arrays_.find(name) != arrays_.end(); }
  float number(std::string_view name, std::size_t i) const {
    return std::bit_cast<float>(word(name, i));
  }
  std::int32_t whole(std::string_view name, std::size_t i) const {
    return static_cast<std::int32_t>(word(name, i));
  }
  const Arrays& arrays() const { return arrays_; }

 private:
  std::uint32_t word(std::string_view name, std::size_t i) const {
    return arrays_.find(name)->second[i];
  }

  Arrays arrays_;
};

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
    if (kernels_.values) try_channels(Results(nacre::run(kernels_.values->kernel, in_, count_)));
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

  void expect_all(const Results& results, std::string_view prefix, bool (*holds)(float),
                  std::string_view law) {
    for (const auto& [name, column] : results.arrays()) {
      if (name != prefix && !name.starts_with(std::string(prefix) + ".")) continue;
      for (std::size_t i = 0; i < count_; ++i) {
        const float x = std::bit_cast<float>(column[i]);
        expect(holds(x), law, i, [&] { return fmt::format("{} = {}", name, x); });
      }
    }
  }

  void expect_unit(const Results& results, const std::string& name, bool zero_too,
                   std::string_view law) {
    if (!results.has(name + ".x")) return;
    for (std::size_t i = 0; i < count_; ++i) {
      const double x = results.number(name + ".x", i), y = results.number(name + ".y", i),
                   z = results.number(name + ".z", i);
      const double length2 = x * x + y * y + z * z;
      expect(std::abs(length2 - 1.0) <= 2e-5 || (zero_too && length2 == 0.0), law, i,
             [&] { return fmt::format("{} = ({}, {}, {})", name, x, y, z); });
    }
  }

  Results run(const BoundKernel& kernel) { return Results(nacre::run(kernel, in_, count_)); }

  void try_material(const MaterialKernels& material) {
    if (material.begin) {
      const Results begun = run(*material.begin);
      for (const auto& [name, column] : begun.arrays()) in_[name] = column;
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

  void try_evaluate(const Results& e) {
    expect_all(e, "f", sane, "f is finite and not negative");
    expect_all(e, "pdf", sane, "pdf is finite and not negative");
    expect_all(e, "pdf_reverse", sane, "pdf_reverse is finite and not negative");
    for (std::size_t i = 0; i < count_; ++i) {
      const float light = std::max({e.number("f.x", i), e.number("f.y", i), e.number("f.z", i)});
      expect(!(light > 0.0f) || e.number("pdf", i) > 0.0f, "f > 0 needs pdf > 0", i,
             [&] { return fmt::format("f = {}, pdf = {}", light, e.number("pdf", i)); });
    }
  }

  void try_sample(const MaterialKernels& material, const Results& s) {
    expect_all(s, "weight", sane, "weight is finite and not negative");
    expect_all(s, "pdf", sane, "a sample's pdf is finite and not negative");
    expect_all(s, "pdf_reverse", sane, "a sample's pdf_reverse is finite and not negative");
    for (std::size_t i = 0; i < count_; ++i) try_direction(material, s, i);
    for (const char* name : {"wi.x", "wi.y", "wi.z"}) in_[name] = s.arrays().find(name)->second;
    in_["of_lobe"] = s.arrays().find("lobe")->second;
    if (!material.evaluate) return;
    const Results e = run(*material.evaluate);
    for (std::size_t i = 0; i < count_; ++i) compare(s, e, i);
  }

  void try_direction(const MaterialKernels& material, const Results& s, std::size_t i) {
    const double x = s.number("wi.x", i), y = s.number("wi.y", i), z = s.number("wi.z", i);
    const float light =
        std::max({s.number("weight.x", i), s.number("weight.y", i), s.number("weight.z", i)});
    const float pdf = s.number("pdf", i);
    if ((s.whole("flags", i) & sample_valid) == 0) {
      expect(light == 0.0f && pdf == 0.0f, "a lost sample has no light", i,
             [&] { return fmt::format("weight = {}, pdf = {}", light, pdf); });
      return;
    }
    expect(pdf > 0.0f, "a valid sample has a pdf", i, [&] { return fmt::format("pdf = {}", pdf); });
    expect(std::abs(x * x + y * y + z * z - 1.0) <= 2e-5, "wi is unit", i,
           [&] { return fmt::format("wi = ({}, {}, {})", x, y, z); });
    const auto lobes = static_cast<std::int32_t>(material.lobes.size());
    const std::int32_t lobe = s.whole("lobe", i);
    expect(lobe >= 0 && lobe < lobes, "a sample's lobe exists", i,
           [&] { return fmt::format("lobe {} of {}", lobe, lobes); });
  }

  void compare(const Results& s, const Results& e, std::size_t i) {
    const std::int32_t flags = s.whole("flags", i);
    if ((flags & sample_valid) == 0 || (flags & sample_delta) != 0) return;
    const double pdf = s.number("pdf", i), again = e.number("pdf", i);
    // For `fast` LLVM may order sums as it likes, in two kernels differently.
    const bool is_fast = kernels_.way.accuracy == Accuracy::fast;
    expect(is_fast ? agree(pdf, again, 1e-4, smallest) : pdf == again,
           "evaluate has the sample's pdf", i,
           [&] { return fmt::format("sample {}, evaluate {}", pdf, again); });
    for (const char* k : {"x", "y", "z"}) {
      const double weight = s.number(std::string("weight.") + k, i);
      const double f = e.number(std::string("f.") + k, i);
      expect(
          agree(weight * pdf, f, 1e-4, smallest * std::max(1.0, pdf)), "weight pdf is f", i,
          [&] { return fmt::format("weight {} pdf {} = {}, f {}", weight, pdf, weight * pdf, f); });
    }
  }

  void try_emission(const Results& r) {
    expect_all(r, "emission", sane, "emission is finite and not negative");
    expect_all(r, "pdf", sane, "the pdf of emission is finite and not negative");
    const Results point(in_);
    for (std::size_t i = 0; i < count_; ++i) {
      const double light = brightest(r, "emission", i), pdf = r.number("pdf", i);
      // What the rounding of a cosine is larger than carries no light.
      const bool leaves =
          light > 0.0 && is_unit(point, "wo", i) && std::abs(cosine(point, "wo", i)) > 1e-6;
      expect(!leaves || pdf > 0.0, "emission needs a pdf", i,
             [&] { return fmt::format("emission = {}, pdf = {}", light, pdf); });
    }
  }

  /// Changes wo.
  void try_emit(const MaterialKernels& material, const Results& s) {
    expect_unit(s, "emitted", false, "emitted is unit");
    expect_all(s, "weight", sane, "the weight of emitted light is finite and not negative");
    expect_all(s, "pdf", sane, "the pdf of emitted light is finite and not negative");
    for (const char* k : {".x", ".y", ".z"}) {
      in_[std::string("wo") + k] = s.arrays().find(std::string("emitted") + k)->second;
    }
    const Results e = run(*material.emission);
    const Results point(in_);
    for (std::size_t i = 0; i < count_; ++i) {
      const float pdf = s.number("pdf", i), weight = brightest(s, "weight", i);
      expect(pdf > 0.0f || weight == 0.0f, "emitted light has a pdf", i,
             [&] { return fmt::format("weight = {}, pdf = {}", weight, pdf); });
      if (pdf > 0.0f) compare_emitted(s, e, point, i);
    }
  }

  void compare_emitted(const Results& s, const Results& e, const Results& point, std::size_t i) {
    const double pdf = s.number("pdf", i), again = e.number("pdf", i);
    const bool is_fast = kernels_.way.accuracy == Accuracy::fast;
    expect(is_fast ? agree(pdf, again, 1e-3, smallest) : pdf == again,
           "emission has the pdf of emitted light", i,
           [&] { return fmt::format("emit {}, emission {}", pdf, again); });
    for (const char* k : {".x", ".y", ".z"}) {
      const double weight = s.number(std::string("weight") + k, i);
      const double emission = e.number(std::string("emission") + k, i);
      const double light = emission * std::abs(cosine(point, "wo", i));
      // A cosine of floats has so many digits.
      const double rounding = 1e-6 * emission;
      expect(weight == largest ||
                 agree(weight * pdf, light, 1e-3, rounding + smallest * std::max(1.0, pdf)),
             "weight pdf is emission cos", i, [&] {
               return fmt::format("weight {} pdf {} = {}, emission cos {}", weight, pdf,
                                  weight * pdf, light);
             });
    }
  }

  /// To Ng.
  static double cosine(const Results& point, const std::string& w, std::size_t i) {
    double sum = 0.0;
    for (const char* k : {".x", ".y", ".z"}) {
      sum += double(point.number(w + k, i)) * double(point.number(std::string("Ng") + k, i));
    }
    return sum;
  }

  /// As a kernel takes it.
  static bool is_unit(const Results& point, const std::string& w, std::size_t i) {
    double sum = 0.0;
    for (const char* k : {".x", ".y", ".z"}) sum += std::pow(double(point.number(w + k, i)), 2.0);
    return std::abs(sum - 1.0) < 0.9e-3;
  }

  static float brightest(const Results& r, const std::string& name, std::size_t i) {
    return std::max({r.number(name + ".x", i), r.number(name + ".y", i), r.number(name + ".z", i)});
  }

  /// What other entries give, by name.
  void try_channels(const Results& r) {
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
    if (r.has("out.distance")) {
      expect_unit(r, "out.direction", true, "the direction to a light is unit");
    }
    for (const auto& [name, column] : r.arrays()) is_known(name);
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
