#include "tests/pbs/battery/lobe_kernels.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>

#include "jit/compile/compile.h"
#include "jit/service/compile_service.h"
#include "tests/support/random.h"

namespace nacre {

namespace {

CompileService* service() {
  static Diagnostics diagnostics;
  static const std::unique_ptr<CompileService> service =
      CompileService::create({.threads = 1, .cache = {}, .session = {}}, diagnostics);
  return service.get();
}

/// Empty where there is none.
std::vector<float> take(Columns& columns, const char* name) { return std::move(columns[name]); }

}  // namespace

LobePrograms lobe_programs(const LobeCase& row, Accuracy accuracy, const LobeRequest& wanted) {
  Recorder recorder;
  const auto channel = [&](const char* name) { return input(recorder, name); };
  const LobeInputs inputs{.roughness = channel("roughness"),
                          .color = {channel("color.x"), channel("color.y"), channel("color.z")},
                          .index = channel("index")};
  Ports more;
  if (wanted.hostile) {
    more["weight"] = number(channel("weight"));
    more["normal"] = {Type::vector3,
                      Float3(channel("normal.x"), channel("normal.y"), channel("normal.z"))};
  }
  Surface surface;
  surface.bsdf = make_lobe(recorder, row, inputs, accuracy, more);
  KernelRequest request;
  request.reverse_pdf = wanted.reverse_pdf;
  const SurfaceKernels kernels = record_kernels(recorder, surface, accuracy, request);
  const Program& all = recorder.program();
  LobePrograms made{.begin = {},
                    .evaluate = slice(all, "evaluate", kernels.evaluate, wanted.keeps),
                    .sample = slice(all, "sample", kernels.sample, wanted.keeps),
                    .albedo = slice(all, "albedo", kernels.albedo)};
  std::set<std::uint32_t> kept;
  for (const Program* program : {&made.evaluate, &made.sample}) {
    for (const std::uint32_t k : state_channels(*program)) kept.insert(k);
  }
  const std::vector<std::uint32_t> keeps(kept.begin(), kept.end());
  made.begin = slice(all, "begin", state_outputs(recorder, keeps));
  return made;
}

std::shared_ptr<const Kernel> lobe_kernel(Program program, Accuracy accuracy, Backend backend) {
  CompileOptions options;
  options.accuracy = accuracy;
  options.backend = backend;
  Diagnostics diagnostics;
  auto kernel = compile(std::move(program), options, service(), diagnostics);
  EXPECT_NE(kernel, nullptr);
  return kernel;
}

LobeKernels::LobeKernels(const LobeCase& row, Accuracy accuracy, Backend backend,
                         bool reverse_pdf) {
  LobePrograms programs =
      lobe_programs(row, accuracy, {.reverse_pdf = reverse_pdf, .keeps = Keeps::load});
  begin_ = lobe_kernel(std::move(programs.begin), accuracy, backend);
  evaluate_ = lobe_kernel(std::move(programs.evaluate), accuracy, backend);
  sample_ = lobe_kernel(std::move(programs.sample), accuracy, backend);
  albedo_ = lobe_kernel(std::move(programs.albedo), accuracy, backend);
}

Columns lobe_columns(float roughness) {
  return {{"roughness", {roughness}}, {"color.x", {1.0f}}, {"color.y", {1.0f}}, {"index", {1.5f}},
          {"color.z", {1.0f}},        {"N.z", {1.0f}},     {"T.x", {1.0f}}};
}

void set_directions(Columns& columns, const std::string& name, const std::vector<Direction>& w) {
  std::vector<float>& x = columns[name + ".x"];
  std::vector<float>& y = columns[name + ".y"];
  std::vector<float>& z = columns[name + ".z"];
  for (auto* each : {&x, &y, &z}) each->clear(), each->reserve(w.size());
  for (const Direction& d : w) x.push_back(d.x), y.push_back(d.y), z.push_back(d.z);
}

void set_random(Columns& columns, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  for (const char* name : {"u.x", "u.y", "u.z"}) {
    std::vector<float>& column = columns[name];
    column.resize(count);
    for (float& u : column) u = static_cast<float>(random.word() >> 40) * 0x1p-24f;
  }
}

Evaluated LobeKernels::evaluate(float roughness, Direction wo,
                                const std::vector<Direction>& wi) const {
  return evaluate(roughness, std::vector<Direction>{wo}, wi);
}

Evaluated LobeKernels::evaluate(float roughness, const std::vector<Direction>& wo,
                                const std::vector<Direction>& wi) const {
  Columns columns = viewed(roughness, wo);
  set_directions(columns, "wi", wi);
  Columns out = run(*evaluate_, columns);
  return {take(out, "f.x"), take(out, "pdf"), take(out, "pdf_reverse")};
}

Columns LobeKernels::viewed(float roughness, const std::vector<Direction>& wo) const {
  Columns columns = lobe_columns(roughness);
  set_directions(columns, "wo", wo);
  columns.merge(run(*begin_, columns));
  return columns;
}

Sampled LobeKernels::sample(float roughness, Direction wo, std::size_t count,
                            std::uint64_t seed) const {
  Columns columns = viewed(roughness, {wo});
  set_random(columns, count, seed);
  Columns out = run(*sample_, columns);
  Sampled sampled;
  sampled.weight = take(out, "weight.x");
  sampled.pdf = take(out, "pdf");
  sampled.pdf_reverse = take(out, "pdf_reverse");
  for (std::size_t i = 0; i < count; ++i) {
    sampled.wi.push_back({out.at("wi.x")[i], out.at("wi.y")[i], out.at("wi.z")[i]});
    sampled.valid.push_back((static_cast<int>(out.at("flags")[i]) & sample_valid) != 0);
  }
  return sampled;
}

double LobeKernels::albedo(float roughness, Direction wo) const {
  Columns columns = lobe_columns(roughness);
  set_directions(columns, "wo", {wo});
  return run(*albedo_, columns).at("albedo.x")[0];
}

}  // namespace nacre
