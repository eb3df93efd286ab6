// Tables in place of what lobes work out for a view, against lobes that work it out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "jit/tune/error.h"
#include "runtime/program/digest.h"
#include "tests/jit/tune/documents.h"
#include "tests/support/material_text.h"

namespace nacre {
namespace {

std::unique_ptr<MaterialKernels> compiled(const std::string& bsdf, const ShaderOptions& options) {
  Diagnostics diagnostics;
  auto kernels =
      tune_system().compile_material(*document_of(material_of(bsdf)), "M", options, diagnostics);
  EXPECT_NE(kernels, nullptr) << diagnostics.to_string();
  return kernels;
}

ShaderOptions with_tables(double error, int lanes = 0, Backend backend = Backend::jit) {
  ShaderOptions options;
  options.kernels.table_error = error;
  options.compile.table_error = 0;  // Nor those of what depends on one number.
  options.compile.lanes = lanes;
  options.compile.backend = backend;
  options.footprints = false;
  return options;
}

/// Views all over one side, many of them grazing.
Columns views(std::size_t count, bool below) {
  std::mt19937 random(5);
  const auto unit = [&] { return static_cast<double>(random()) * 0x1p-32; };
  Columns made;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = std::pow(unit(), 1 + i % 3), phi = 6.283185307179586 * unit();
    const double ring = std::sqrt(1 - z * z);
    made["wo.x"].push_back(static_cast<float>(ring * std::cos(phi)));
    made["wo.y"].push_back(static_cast<float>(ring * std::sin(phi)));
    made["wo.z"].push_back(static_cast<float>(below ? -z : z));
  }
  return made;
}

Columns run(const BoundKernel& kernel, const Columns& views) {
  const std::size_t count = views.at("wo.x").size();
  Columns out, given = views;
  for (const auto& [name, axis] : {std::pair("N", 2), {"Ng", 2}, {"T", 0}, {"B", 1}}) {
    for (int k = 0; k < 3; ++k) {
      given[std::string(name) + '.' + "xyz"[k]].assign(count, k == axis ? 1.0f : 0.0f);
    }
  }
  std::vector<const void*> inputs;
  for (const Channel& channel : kernel.program().inputs) {
    inputs.push_back(given.at(channel.name).data());
  }
  for (const Channel& channel : kernel.program().outputs) out[channel.name].resize(count);
  std::vector<void*> outputs;
  for (const Channel& channel : kernel.program().outputs) {
    outputs.push_back(out[channel.name].data());
  }
  EXPECT_EQ(kernel.run(inputs, outputs, count), RunStatus::done);
  return out;
}

const char* const metal = R"(<conductor_bsdf name="b" type="BSDF">
  <input name="roughness" type="vector2" value="{}, {}"/></conductor_bsdf>)";
const char* const glass = R"(<dielectric_bsdf name="b" type="BSDF">
  <input name="scatter_mode" type="string" value="RT"/>
  <input name="roughness" type="vector2" value="{}, {}"/></dielectric_bsdf>)";

std::string rough(const char* bsdf, double x, double y) {
  return fmt::format(fmt::runtime(bsdf), x, y);
}

bool has_view_table(const BoundKernel& kernel) {
  return std::ranges::any_of(kernel.program().tables, [](const Table& table) {
    return table.name.starts_with("view_table.");
  });
}

class Tables : public testing::TestWithParam<std::string> {};

// The promise is about the middle of cells, where a linear table is furthest off what is smooth.
TEST_P(Tables, AreAsExactAsTheyAreAskedToBe) {
  const Columns from = views(20000, false);
  const Columns exact = run(*compiled(GetParam(), with_tables(0))->begin, from);
  int tables = 0;
  for (const double error : {1e-2, 1e-3}) {
    const auto kernels = compiled(GetParam(), with_tables(error));
    if (!has_view_table(*kernels->begin)) continue;
    ++tables;
    const Columns found = run(*kernels->begin, from);
    for (const auto& [name, column] : exact) {
      for (std::size_t i = 0; i < column.size(); ++i) {
        ASSERT_NEAR(found.at(name)[i], column[i], 1.5 * error * std::max(std::abs(column[i]), 0.1f))
            << name << " from cosine " << from.at("wo.z")[i] << " for " << error;
      }
    }
  }
  EXPECT_GT(tables, 0);
}

TEST_P(Tables, AreNotOfViewsFromBelow) {
  const Columns from = views(2000, true);
  const Columns exact = run(*compiled(GetParam(), with_tables(0))->begin, from);
  const Columns found = run(*compiled(GetParam(), with_tables(1e-2))->begin, from);
  for (const auto& [name, column] : exact) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      // What is rounded together may be chosen otherwise.
      ASSERT_NEAR(found.at(name)[i], column[i], 1e-5 * std::max(std::abs(column[i]), 0.1f));
    }
  }
}

TEST_P(Tables, GiveTheSameBitsOnEveryEngineAndWidth) {
  const Columns from = views(777, false);
  const Columns wide = run(*compiled(GetParam(), with_tables(1e-2, 16))->begin, from);
  for (const int lanes : {1, 4, 8}) {
    EXPECT_TRUE(run(*compiled(GetParam(), with_tables(1e-2, lanes))->begin, from) == wide) << lanes;
  }
  const auto interpreted = compiled(GetParam(), with_tables(1e-2, 0, Backend::interpreter));
  EXPECT_TRUE(run(*interpreted->begin, from) == wide);
}

INSTANTIATE_TEST_SUITE_P(All, Tables,
                         testing::Values(rough(metal, 0.3, 0.3), rough(metal, 0.5, 0.1),
                                         rough(glass, 0.4, 0.4)));

TEST(TablesOfViews, AreNotMadeWhereOtherThingsMatter) {
  ShaderOptions exact = with_tables(0), live = with_tables(1e-2);
  exact.live = live.live = {"*"};
  const auto a = compiled(rough(metal, 0.3, 0.3), exact),
             b = compiled(rough(metal, 0.3, 0.3), live);
  EXPECT_FALSE(has_view_table(*b->begin));
  EXPECT_EQ(a->begin->program().inputs, b->begin->program().inputs);
}

TEST(TablesOfViews, AreTheSameEveryTime) {
  ShaderOptions options = with_tables(1e-2);
  options.compile.whole = true;
  const auto a = compiled(rough(metal, 0.5, 0.1), options);
  const auto b = compiled(rough(metal, 0.5, 0.1), options);
  EXPECT_TRUE(has_view_table(*a->begin));
  EXPECT_EQ(digest(a->begin->program()), digest(b->begin->program()));
}

}  // namespace
}  // namespace nacre
