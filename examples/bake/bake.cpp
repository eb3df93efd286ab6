#include "examples/bake/bake.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>

#include "examples/bake/plane.h"
#include "examples/common/leave_cores.h"
#include "examples/common/run_on_threads.h"

namespace nacre::host {

namespace {

/// Runs the kernel on strips of rows; every strip has its own buffers.
class Baker {
 public:
  Baker(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings)
      : kernel_(kernel),
        output_(kernel.outputs[output]),
        plane_(settings.width, settings.height, settings.corner_u, settings.corner_v),
        parameters_(kernel.kernel.parameters()) {
    set("frame", settings.frame);
    set("time", settings.time);
  }

  int components() const { return component_count(output_.type); }

  /// What one call of the kernel gets: enough points to be worth it, few enough that it
  /// soon sees that there is compiled code.
  int points_of_a_strip() const {
    constexpr std::size_t operations = std::size_t{1} << 28;
    const std::size_t points =
        operations / std::max<std::size_t>(1, instruction_count(kernel_.kernel.program()));
    return static_cast<int>(std::clamp<std::size_t>(points, 256, 16384));
  }

  /// Bytes that one row takes while it is computed.
  std::size_t row_bytes() const {
    const Program& program = kernel_.kernel.program();
    const std::size_t channels =
        program.inputs.size() + program.outputs.size() + static_cast<std::size_t>(components());
    return channels * sizeof(float) * static_cast<std::size_t>(plane_.width());
  }

  RunStatus strip(int first, int rows, float* texels,
                  const std::atomic<std::uint32_t>& stop) const {
    const Program& program = kernel_.kernel.program();
    const auto points = static_cast<std::size_t>(rows) * static_cast<std::size_t>(plane_.width());
    std::vector<std::vector<float>> inputs(program.inputs.size());
    std::vector<const void*> in;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      plane_.fill(program.inputs[i].name, first, rows, inputs[i]);
      in.push_back(inputs[i].data());
    }
    std::vector<std::vector<std::uint32_t>> outputs(program.outputs.size());
    std::vector<void*> out;
    for (auto& channel : outputs) {
      channel.resize(points);
      out.push_back(channel.data());
    }
    const RunStatus status = kernel_.kernel.run(in, out, points, parameters_, &stop);
    if (status != RunStatus::done) return status;
    const auto count = static_cast<std::size_t>(components());
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t channel = output_.first_channel + c;
      const bool is_float = program.outputs[channel].type == Scalar::f32;
      for (std::size_t i = 0; i < points; ++i) {
        const std::uint32_t bits = outputs[channel][i];
        texels[i * count + c] = is_float ? std::bit_cast<float>(bits)
                                         : static_cast<float>(static_cast<std::int32_t>(bits));
      }
    }
    return RunStatus::done;
  }

 private:
  void set(std::string_view name, float value) {
    if (const auto index = kernel_.kernel.parameter_index(name)) {
      parameters_[*index] = std::bit_cast<std::uint32_t>(value);
    }
  }

  const OutputKernel& kernel_;
  const OutputKernel::Output& output_;
  Plane plane_;
  std::vector<std::uint32_t> parameters_;
};

}  // namespace

BakeResult bake(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                const std::function<bool(const BakedRows&)>& sink, const BakeControl& control) {
  const Baker baker(kernel, output, settings);
  const auto row_texels =
      static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(baker.components());
  const int strip_rows = std::clamp(baker.points_of_a_strip() / settings.width, 1, settings.height);
  const auto band_rows = static_cast<int>(std::clamp<std::size_t>(
      settings.memory / std::max<std::size_t>(1, baker.row_bytes()),
      static_cast<std::size_t>(strip_rows), static_cast<std::size_t>(settings.height)));
  // Ends all strips that are being computed: asked for, or because one of them failed.
  std::atomic<std::uint32_t> ends = 0;
  std::atomic<bool> too_many_steps = false;
  const std::stop_callback asked(control.stop, [&] { ends = 1; });
  BakedRows band;
  for (int first = 0; first < settings.height; first += band_rows) {
    if (control.stop.stop_requested()) return BakeResult::stopped;
    band.first = first;
    band.rows = std::min(band_rows, settings.height - first);
    band.texels.resize(static_cast<std::size_t>(band.rows) * row_texels);
    const int strips = (band.rows + strip_rows - 1) / strip_rows;
    std::atomic<int> next_strip = 0;
    std::atomic<int> next_thread = 0;
    const int threads = std::min(thread_count(settings.threads), strips);
    run_on_threads(threads, [&] {
      try {
        leave_cores(
            next_thread++, threads, [&] { return kernel.kernel.is_pending() ? 1 : 0; },
            [&] { return next_strip >= strips || ends != 0; });
        for (int strip = next_strip++; strip < strips && ends == 0; strip = next_strip++) {
          const int begin = strip * strip_rows;
          const RunStatus status =
              baker.strip(first + begin, std::min(strip_rows, band.rows - begin),
                          band.texels.data() + static_cast<std::size_t>(begin) * row_texels, ends);
          if (status == RunStatus::done || status == RunStatus::stopped) continue;
          assert(status == RunStatus::too_many_steps);  // It has what its Program asks for.
          too_many_steps = true;
          ends = 1;
        }
      } catch (...) {
        ends = 1;
        throw;
      }
    });
    if (too_many_steps) return BakeResult::too_many_steps;
    if (ends != 0) return BakeResult::stopped;
    if (!sink(band)) return BakeResult::refused;
    if (control.progress) {
      control.progress(static_cast<double>(first + band.rows) / settings.height);
    }
  }
  return BakeResult::done;
}

void report_too_many_steps(const OutputKernel::Output& output, Diagnostics& diagnostics) {
  diagnostics.error("too-many-steps", output.where,
                    "output '" + output.name +
                        "' takes too many steps for a point, or a loop of it does not end");
}

std::vector<float> bake_image(const OutputKernel& kernel, std::size_t output,
                              const BakeSettings& settings) {
  std::vector<float> image;
  const BakeResult result = bake(kernel, output, settings, [&](const BakedRows& rows) {
    image.insert(image.end(), rows.texels.begin(), rows.texels.end());
    return true;
  });
  if (result != BakeResult::done) image.clear();
  return image;
}

}  // namespace nacre::host
