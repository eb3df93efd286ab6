#include "pbs/view_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "pbs/tables/look_up.h"
#include "runtime/program/digest.h"
#include "runtime/program/slice.h"
#include "runtime/reference/reference.h"

namespace nacre {

namespace {

/// What takes fewer operations costs no more than the look-up.
constexpr double least_operations = 100;
/// Operations in double precision for a table: two seconds.
constexpr double most_operations_to_make = 2e8;

/// Cells along the height of the view, by the root of its cosine since most happens at grazing;
/// and around, by the square of the cosine of its azimuth, in which lobes are smooth.
struct Cells {
  int up, around;
};
constexpr std::array<Cells, 4> isotropic_cells{{{32, 1}, {64, 1}, {128, 1}, {256, 1}}};
constexpr std::array<Cells, 3> anisotropic_cells{{{32, 8}, {48, 16}, {64, 32}}};

constexpr std::array<const char*, 3> view_channels{"view_table.x", "view_table.y", "view_table.z"};

/// Errors below that share of 1 are small whatever they are a share of: what is worked out for a
/// view are factors and shares of light.
constexpr double error_floor = 0.1;

/// A view from above at t along the cosine's root and v along the azimuth's square.
std::array<float, 3> view_at(double t, double v) {
  const double z = std::max(t * t, 1e-6);
  const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {static_cast<float>(across * std::sqrt(v)),
          static_cast<float>(across * std::sqrt(1.0 - v)), static_cast<float>(z)};
}

/// Runs a Program of the view alone in double precision.
class Oracle {
 public:
  Oracle(const Program& program, std::size_t quantities)
      : kernel_(make_reference(program)), quantities_(quantities) {}

  /// Operations for a view, on average of a few.
  double cost() const {
    OpCounts counts{};
    const Cells few{4, 2};
    run(views(few, 0.5),
        [&](const KernelArguments& arguments) { return kernel_->run_counted(arguments, counts); });
    return static_cast<double>(std::reduce(counts.begin(), counts.end())) / (few.up * few.around);
  }

  /// All quantities at each node of so many cells, along the first axis first; `offset`: by how
  /// many cells the nodes are moved, which leaves out the last. Empty where it takes too long.
  std::vector<float> at_nodes(Cells cells, double offset) const {
    return run(views(cells, offset),
               [&](const KernelArguments& arguments) { return kernel_->run(arguments); });
  }

 private:
  using Views = std::array<std::vector<float>, 3>;

  static Views views(Cells cells, double offset) {
    const int last = offset > 0 ? 0 : 1;
    Views wo;
    for (int j = 0; j < cells.around + last; ++j) {
      for (int i = 0; i < cells.up + last; ++i) {
        const auto view = view_at((i + offset) / cells.up, (j + offset) / cells.around);
        for (std::size_t k = 0; k < 3; ++k) wo[k].push_back(view[k]);
      }
    }
    return wo;
  }

  template <class F>
  std::vector<float> run(const Views& wo, F&& kernel) const {
    const std::size_t count = wo[0].size();
    std::vector<const void*> inputs;
    for (const Channel& channel : kernel_->program().inputs) {
      const auto k = std::ranges::find(view_channels, channel.name) - view_channels.begin();
      inputs.push_back(wo[static_cast<std::size_t>(k)].data());
    }
    std::vector<std::vector<float>> columns(quantities_, std::vector<float>(count));
    std::vector<void*> outputs;
    for (std::vector<float>& column : columns) outputs.push_back(column.data());
    KernelArguments arguments;
    arguments.inputs = inputs.data();
    arguments.outputs = outputs.data();
    arguments.count = count;
    if (kernel(arguments) != RunStatus::done) return {};
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::vector<float>& column : columns) values.push_back(column[i]);
    }
    return values;
  }

  std::unique_ptr<ReferenceKernel> kernel_;
  std::size_t quantities_;
};

/// The largest error in the middle of the cells.
double error_of(const std::vector<float>& nodes, const std::vector<float>& middles, Cells cells,
                std::size_t quantities) {
  const auto row = static_cast<std::size_t>(cells.up + 1) * quantities;
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(cells.around); ++j) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(cells.up); ++i) {
      for (std::size_t q = 0; q < quantities; ++q, ++at) {
        const float* const corner = nodes.data() + j * row + i * quantities + q;
        const double mean = 0.25 * (double(corner[0]) + corner[quantities] + corner[row] +
                                    corner[row + quantities]);
        const double exact = middles[at];
        const double off = std::abs(mean - exact) / std::max(std::abs(exact), error_floor);
        worst = std::max(worst, std::isfinite(off) ? off : 1e30);
      }
    }
  }
  return worst;
}

bool is_of_view_alone(const Program& program) {
  return program.parameters.empty() && program.textures.empty() &&
         std::ranges::all_of(program.inputs, [](const Channel& channel) {
           return std::ranges::find(view_channels, channel.name) != view_channels.end();
         });
}

/// Values at nodes that are close enough; nothing where no number of cells is.
struct Nodes {
  Cells cells;
  std::vector<float> values;
};
std::optional<Nodes> nodes_of(const Oracle& oracle, std::span<const Cells> all,
                              std::size_t quantities, double max_error) {
  const double operations = oracle.cost();
  if (operations < least_operations) return std::nullopt;
  for (const Cells& cells : all) {
    const double count = 2.0 * (cells.up + 1) * (cells.around + 1);
    if (count * operations > most_operations_to_make) return std::nullopt;
    const std::vector<float> nodes = oracle.at_nodes(cells, 0.0);
    const std::vector<float> middles = oracle.at_nodes(cells, 0.5);
    if (nodes.empty() || middles.empty()) return std::nullopt;
    if (error_of(nodes, middles, cells, quantities) <= max_error) return Nodes{cells, nodes};
  }
  return std::nullopt;
}

std::vector<Float> look_up_nodes(Recorder& recorder, const Nodes& nodes, const std::string& name,
                                 std::size_t quantities, Float up, Float around) {
  FacetTable table;
  table.name = name;
  table.quantities = static_cast<int>(quantities);
  table.angles = nodes.cells.up + 1;
  table.roughnesses = nodes.cells.around + 1;
  table.indices = 1;
  table.values = nodes.values;
  return look_up(recorder, table, up, around);
}

}  // namespace

std::optional<std::vector<Float>> from_view_table(const View& view, const LocalView& local,
                                                  bool isotropic, const OfView& of_view) {
  Recorder& recorder = *view.recorder;
  View seen = view;
  seen.left_out = seen.unseen = nullptr;
  seen.media = nullptr;
  seen.wo = {Float(recorder.input(view_channels[0], Scalar::f32)),
             Float(recorder.input(view_channels[1], Scalar::f32)),
             Float(recorder.input(view_channels[2], Scalar::f32))};
  const std::vector<Float> wanted = of_view(seen);
  std::vector<SliceOutput> outputs;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    outputs.push_back({std::to_string(i), wanted[i].ref()});
  }
  const Program program = slice(recorder.program(), "view_table", outputs);
  if (!is_of_view_alone(program)) return std::nullopt;

  const Oracle oracle(program, wanted.size());
  const auto cells = isotropic ? std::span<const Cells>(isotropic_cells)
                               : std::span<const Cells>(anisotropic_cells);
  const std::optional<Nodes> nodes = nodes_of(oracle, cells, wanted.size(), view.table_error);
  if (!nodes) return std::nullopt;

  const Float up = sqrt(local.wo.z);
  const Float x2 = square(local.wo.x), across2 = fma(local.wo.y, local.wo.y, x2);
  const Float around = isotropic ? Float(0.0f) : x2 / max(across2, 1e-30f);
  const std::string name = "view_table." + to_hex(digest(program)).substr(0, 16);
  return look_up_nodes(recorder, *nodes, name, wanted.size(), up, around);
}

}  // namespace nacre
