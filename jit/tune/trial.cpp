#include "jit/tune/trial.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "jit/tune/estimate.h"
#include "jit/tune/points.h"
#include "runtime/program/digest.h"

namespace nacre {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A kernel with its arrays.
class Run {
 public:
  Run(const BoundKernel& kernel, const TunePoints& points, const Columns& state)
      : kernel_(kernel), count_(points.count), parameters_(kernel.parameters()) {
    const Program& program = kernel.program();
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      // Every mesh has what a document asks for.
      if (program.parameters[i].name.starts_with("geomprop.")) parameters_[i] = 1;
    }
    for (const Channel& channel : program.inputs) {
      inputs_.push_back(column(channel, points, state));
      input_arrays_.push_back(inputs_.back().data());
    }
    for (const Channel& channel : program.outputs) {
      results_[channel.name].assign(count_, 0.0f);
    }
    for (const Channel& channel : program.outputs) {
      output_arrays_.push_back(results_[channel.name].data());
    }
  }

  bool operator()() {
    return kernel_.run(input_arrays_, output_arrays_, count_, parameters_) == RunStatus::done;
  }
  const Columns& results() const { return results_; }

 private:
  static std::vector<float> column(const Channel& channel, const TunePoints& points,
                                   const Columns& state) {
    if (const auto kept = state.find(channel.name); kept != state.end()) return kept->second;
    const auto given = points.given.find(channel.name);
    return given != points.given.end() ? given->second
                                       : shading_points(channel, points.count, points.set);
  }

  const BoundKernel& kernel_;
  std::size_t count_;
  std::vector<std::uint32_t> parameters_;
  std::vector<std::vector<float>> inputs_;
  Columns results_;
  std::vector<const void*> input_arrays_;
  std::vector<void*> output_arrays_;
};

/// Uniform on the sphere.
void add_direction(std::mt19937& random, float (&w)[3]) {
  const auto unit = [&] { return static_cast<double>(random()) * 0x1p-32; };
  const double z = 2.0 * unit() - 1.0, phi = 2.0 * std::numbers::pi * unit();
  const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
  w[0] = static_cast<float>(ring * std::cos(phi));
  w[1] = static_cast<float>(ring * std::sin(phi));
  w[2] = static_cast<float>(z);
}

}  // namespace

std::unique_ptr<TuneTrial> TuneTrial::compile(const TuneSubject& subject,
                                              const ShaderOptions& options,
                                              Diagnostics& diagnostics) {
  std::unique_ptr<TuneTrial> made(new TuneTrial());
  if (subject.is_material) {
    made->material_ =
        subject.system->compile_material(*subject.document, subject.name, options, diagnostics);
  } else {
    made->outputs_ =
        subject.system->compile_outputs(*subject.document, {subject.name}, options, diagnostics);
  }
  if (made->material_ == nullptr && made->outputs_ == nullptr) return nullptr;
  if (diagnostics.has_errors()) return nullptr;
  std::string all;
  for (const auto& [name, kernel] : made->kernels()) {
    all += std::string(name) + to_hex(nacre::digest(kernel->program()));
  }
  made->digest_ = sha256(all);
  return made;
}

std::vector<TuneTrial::Named> TuneTrial::kernels() const {
  if (outputs_ != nullptr) return {{"outputs", &outputs_->kernel}};
  const std::pair<std::string_view, const std::optional<BoundKernel>*> all[]{
      {"begin", &material_->begin},
      {"sample", &material_->sample},
      {"evaluate", &material_->evaluate},
      {"albedo", &material_->albedo},
      {"emission", &material_->emission},
      {"opacity", &material_->opacity},
      {"displacement", &material_->displacement},
      {"volume", &material_->volume},
      {"light", &material_->light}};
  std::vector<Named> present;
  for (const auto& [name, kernel] : all) {
    if (kernel->has_value()) present.emplace_back(name, &**kernel);
  }
  return present;
}

double TuneTrial::cost(const TunePoints& points) const {
  double sum = 0;
  Columns state;
  for (const auto& [name, kernel] : kernels()) {
    if (name == "albedo") continue;
    const auto counting = std::make_shared<const CountingKernel>(kernel->program());
    const BoundKernel bound = kernel->with(counting);
    Run run(bound, points, state);
    if (!run()) return 0;
    if (name == "begin") state = run.results();
    sum += counting->cost();
  }
  return sum;
}

Columns TuneTrial::results(const TunePoints& points) const {
  Columns state, all;
  for (const auto& [name, kernel] : kernels()) {
    if (name == "sample") continue;
    Run run(*kernel, points, state);
    if (!run()) return {};
    if (name == "begin") {
      state = run.results();
      continue;
    }
    for (const auto& [channel, column] : run.results()) {
      if (channel != "pdf") all[channel] = column;
    }
  }
  return all;
}

Columns TuneTrial::directions(const TunePoints& points) const {
  std::mt19937 random(points.set);
  Columns made;
  std::vector<float>* const wi[]{&made["wi.x"], &made["wi.y"], &made["wi.z"]};
  for (std::size_t i = 0; i < points.count; ++i) {
    float w[3];
    add_direction(random, w);
    for (int k = 0; k < 3; ++k) wi[k]->push_back(w[k]);
  }
  if (material_ == nullptr || !material_->sample) return made;
  Columns state;
  if (material_->begin) {
    Run begin(*material_->begin, points, {});
    if (!begin()) return made;
    state = begin.results();
  }
  Run sample(*material_->sample, points, state);
  if (!sample()) return made;
  const Columns& s = sample.results();
  for (std::size_t i = 0; i < points.count; i += 2) {
    if ((std::bit_cast<std::int32_t>(s.at("flags")[i]) & sample_valid) == 0) continue;
    for (int k = 0; k < 3; ++k) (*wi[k])[i] = s.at(std::string("wi.") + "xyz"[k])[i];
  }
  return made;
}

double TuneTrial::nanoseconds(const TunePoints& points, double seconds) const {
  double sum = 0;
  Columns state;
  for (const auto& [name, kernel] : kernels()) {
    if (name == "albedo") continue;
    Run run(*kernel, points, state);
    run();  // Pages, caches, and images that are read when they are first needed.
    if (name == "begin") state = run.results();
    double best = 1e300;
    for (const Clock::time_point begun = Clock::now(); seconds_since(begun) < seconds;) {
      const Clock::time_point start = Clock::now();
      run();
      best = std::min(best, seconds_since(start));
    }
    sum += 1e9 * best / static_cast<double>(points.count);
  }
  return sum;
}

}  // namespace nacre
