#include "jit/tune/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "jit/tune/estimate.h"
#include "runtime/channel/channel_name.h"
#include "runtime/channel/channel_table.h"
#include "runtime/program/digest.h"

namespace nacre {

namespace {

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

std::string TuneSubject::text() const { return fmt::format("{}", fmt::join(names, ", ")); }

std::unique_ptr<TuneTrial> TuneTrial::compile(const TuneSubject& subject,
                                              const ShaderOptions& options,
                                              Diagnostics& diagnostics) {
  std::unique_ptr<TuneTrial> made(new TuneTrial());
  made->stop_ = options.compile.stop;
  if (subject.is_material) {
    made->material_ = subject.system->compile_material(*subject.document, subject.names.at(0),
                                                       options, diagnostics);
  } else {
    made->outputs_ =
        subject.system->compile_outputs(*subject.document, subject.names, options, diagnostics);
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

template <class F>
bool TuneTrial::run_all(const TunePoints& points, F&& use) const {
  Columns given = points.given;
  for (const auto& [name, kernel] : kernels()) {
    KernelRun run(*kernel, given, {}, points.set);
    if (!run(stop_)) return false;
    if (name == "begin") given.merge(run.raw_results());
    use(name, *kernel, run, given);
  }
  return true;
}

double TuneTrial::cost(const TunePoints& points) const {
  double sum = 0;
  run_all(points, [&](std::string_view name, const BoundKernel& kernel, const KernelRun&,
                      const Columns& given) {
    if (name == "albedo") return;
    const auto counting = std::make_shared<const CountingKernel>(kernel.program());
    KernelRun(kernel.with(counting), given, {}, points.set)(stop_);
    sum += counting->cost();
  });
  return sum;
}

Columns TuneTrial::results(const TunePoints& points) const {
  Columns all;
  const bool is_done = run_all(
      points, [&](std::string_view name, const BoundKernel&, const KernelRun& run, const Columns&) {
        if (name != "begin" && name != "sample") all.merge(run.raw_results());
      });
  all.erase("pdf");
  return is_done ? all : Columns();
}

std::set<std::string> TuneTrial::point_channels() const {
  std::set<std::string> found;
  for (const auto& [name, kernel] : kernels()) {
    for (const Channel& channel : kernel->program().inputs) {
      const ChannelGroup* const known = find_channel_group(parse_channel(channel.name).group);
      const bool is_asked = known != nullptr && (known->role == ChannelRole::direction ||
                                                 known->role == ChannelRole::state);
      if (!is_asked) found.insert(channel.name);
    }
  }
  return found;
}

Columns TuneTrial::directions(const TunePoints& points) const {
  std::mt19937 random(points.set.number);
  Columns made;
  std::vector<float>* const wi[]{&made["wi.x"], &made["wi.y"], &made["wi.z"]};
  for (std::size_t i = 0; i < points.set.count; ++i) {
    float w[3];
    add_direction(random, w);
    for (int k = 0; k < 3; ++k) wi[k]->push_back(w[k]);
  }
  run_all(points,
          [&](std::string_view name, const BoundKernel&, const KernelRun& run, const Columns&) {
            if (material_ == nullptr || name != "sample") return;
            const Columns sampled = run.raw_results();
            for (std::size_t i = 0; i < points.set.count; i += 2) {
              if ((std::bit_cast<std::int32_t>(sampled.at("flags")[i]) & sample_valid) == 0)
                continue;
              for (int k = 0; k < 3; ++k) (*wi[k])[i] = sampled.at(channel_text("wi", k))[i];
            }
          });
  return made;
}

double TuneTrial::nanoseconds(const TunePoints& points, double seconds) const {
  double sum = 0;
  run_all(points, [&](std::string_view name, const BoundKernel&, KernelRun& run, const Columns&) {
    if (name != "albedo") sum += nanoseconds_a_point(run, seconds);
  });
  return sum;
}

}  // namespace nacre
