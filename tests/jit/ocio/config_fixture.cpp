#include "tests/jit/ocio/config_fixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <sstream>

#include "tests/support/random.h"
#include "tests/support/run_kernel.h"
#include "tests/support/standard_library.h"

namespace nacre {

namespace ocio = OCIO_NAMESPACE;

void Config::open(const Spaces& spaces) {
  const auto config = ocio::Config::Create();
  config->setSearchPath(".");
  const auto add = [&](const std::string& name, const ocio::ConstTransformRcPtr& transform) {
    const auto space = ocio::ColorSpace::Create();
    space->setName(name.c_str());
    if (transform != nullptr) {
      space->setTransform(transform, ocio::COLORSPACE_DIR_TO_REFERENCE);
    }
    config->addColorSpace(space);
  };
  add("linear", nullptr);
  for (const auto& [name, transform] : spaces) add(name, transform);
  std::ostringstream text;
  config->serialize(text);
  open_text(text.str());
}

void Config::open_text(const std::string& text) {
  const std::string path = folder_.write("config.ocio", text);
  config_ = ocio::Config::CreateFromFile(path.c_str());
  system_ = ShadingSystem::create({.libraries = {standard_library_folder()}, .ocio_config = path},
                                  diagnostics_);
  ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
}

std::vector<Rgba> Config::colors() {
  const std::vector<float> special{0.0f,    -0.0f, 1e-7f,  0.002f, 0.0031308f, 0.04045f, 0.18f,
                                   0.5f,    0.75f, 0.999f, 1.0f,   1.001f,     2.5f,     16.0f,
                                   65504.f, 1e6f,  -1e-3f, -0.1f,  -1.0f,      -7.0f,    -1e6f};
  std::vector<Rgba> result;
  for (const float a : special) {
    for (const float b : special) result.push_back({a, b, special[result.size() % 21], 1.0f});
  }
  Random random(7);
  const auto unit = [&] { return static_cast<float>(random.word() >> 40) * 0x1p-24f; };
  for (int i = 0; i < 2000; ++i) {
    Rgba color{unit(), unit(), unit(), 1.0f};
    if (i % 2 == 0) {
      for (int k = 0; k < 3; ++k) {
        color[static_cast<std::size_t>(k)] =
            std::exp2(32 * unit() - 16) * (random.chance(0.2) ? -1 : 1);
      }
    }
    result.push_back(color);
  }
  return result;
}

std::optional<Graph> Config::graph_of(const std::string& type, const std::string& from,
                                      const std::string& to) {
  const std::string value = type == "color3" ? "1, 1, 1" : "1, 1, 1, 1";
  const std::string text = fmt::format(
      R"(<geomcolor name="g" type="{0}"/><output name="given" type="{0}" nodename="g"/>
         <constant name="c" type="{0}">
           <input name="value" type="{0}" value="{1}" colorspace="{2}"/>
         </constant>
         <output name="out" type="{0}" nodename="c"/>)",
      type, value, from);
  const auto document = document_of(text, diagnostics_);
  ShaderOptions options;
  options.graph.working_space = to;
  return build_graph(*document, system_->library(), {.outputs = {"given", "out"}, .material = {}},
                     system_->graph_options(options), diagnostics_);
}

std::vector<Rgba> Config::convert(const std::vector<Rgba>& colors, const std::string& from,
                                  const std::string& to, Backend backend) {
  auto graph = graph_of("color4", from, to);
  EXPECT_TRUE(graph) << diagnostics_.to_string();
  if (!graph) return {};
  // The transform, which reads a constant, reads the colours of the points instead.
  for (GraphNode& node : graph->nodes) {
    if (!node.category.starts_with("config_transform")) continue;
    node.inputs[0].source = graph->outputs[0].source;
  }
  ShaderOptions options;
  options.compile.backend = backend;
  options.compile.accuracy = Accuracy::precise;
  const auto kernel = system_->compile_outputs(*graph, options, diagnostics_);
  EXPECT_NE(kernel, nullptr) << diagnostics_.to_string();
  if (kernel == nullptr) return {};
  Columns columns;
  for (const Rgba& color : colors) {
    for (std::size_t k = 0; k < 4; ++k) {
      columns[std::string("color0.") + "xyzw"[k]].push_back(color[k]);
    }
  }
  Columns out = run(kernel->kernel.kernel(), columns);
  std::vector<Rgba> result(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) result[i][k] = out[std::string("out.") + "xyzw"[k]].at(i);
  }
  return result;
}

std::vector<Rgba> Config::oracle(const std::vector<Rgba>& colors, const std::string& from,
                                 const std::string& to) const {
  const auto processor = config_->getProcessor(from.c_str(), to.c_str())
                             ->getOptimizedCPUProcessor(ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32,
                                                        ocio::OPTIMIZATION_NONE);
  std::vector<Rgba> result = colors;
  for (Rgba& color : result) processor->applyRGBA(color.data());
  return result;
}

void Config::expect_agreement(const std::vector<Rgba>& colors, const std::string& from,
                              const std::string& to, double error) {
  const std::vector<Rgba> expected = oracle(colors, from, to);
  const std::vector<Rgba> interpreted = convert(colors, from, to, Backend::interpreter);
  const std::vector<Rgba> compiled = convert(colors, from, to, Backend::jit);
  const std::vector<Rgba> reference = convert(colors, from, to, Backend::reference);
  ASSERT_EQ(interpreted.size(), colors.size()) << from << " to " << to;
  ASSERT_EQ(compiled.size(), colors.size()) << from << " to " << to;
  ASSERT_EQ(reference.size(), colors.size()) << from << " to " << to;
  double worst = 0, worst_reference = 0;
  std::size_t where = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    double unit = 1;
    for (std::size_t k = 0; k < 4; ++k) {
      unit = std::max({unit, std::fabs(double{expected[i][k]}), std::fabs(double{colors[i][k]})});
    }
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(interpreted[i][k]),
                std::bit_cast<std::uint32_t>(compiled[i][k]));
      ASSERT_EQ(std::isfinite(expected[i][k]), std::isfinite(compiled[i][k]))
          << from << " to " << to << ' ' << colors[i][0] << ' ' << colors[i][1] << ' '
          << colors[i][2] << ": " << expected[i][k] << " and " << compiled[i][k];
      if (!std::isfinite(expected[i][k])) continue;
      const double difference = std::fabs(double{compiled[i][k]} - expected[i][k]) / unit;
      if (difference > worst) where = i;
      worst = std::max(worst, difference);
      worst_reference =
          std::max(worst_reference, std::fabs(double{reference[i][k]} - expected[i][k]) / unit);
    }
  }
  const auto shown = [](const Rgba& c) {
    return std::to_string(c[0]) + ' ' + std::to_string(c[1]) + ' ' + std::to_string(c[2]) + ' ' +
           std::to_string(c[3]);
  };
  EXPECT_LE(worst, error) << from << " to " << to << ", at " << shown(colors[where]) << ": "
                          << shown(compiled[where]) << ", OpenColorIO " << shown(expected[where]);
  EXPECT_LE(worst_reference, error) << from << " to " << to;
}

}  // namespace nacre
