#pragma once

#include <atomic>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>

#include "examples/render/render.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// How long `nacre render` works, and what it keeps of it.
struct ProgressOptions {
  double time_limit = 0;         ///< --time-limit: seconds of rendering; 0: none.
  std::string checkpoint;        ///< --checkpoint
  double checkpoint_every = 60;  ///< --checkpoint-every

  void add(CLI::App& command);
};

/// When a render has enough: at a signal, or after so many seconds.
class Enough {
 public:
  explicit Enough(double time_limit);
  std::stop_token token() const { return source_.get_token(); }
  /// Whether that was why.
  bool is_out_of_time() const { return out_of_time_; }

 private:
  std::stop_source source_;
  std::stop_callback<std::function<void()>> on_signal_;
  std::atomic<bool> out_of_time_ = false;
  std::jthread timer_;
};

/// Says what samples pixels have, where that is not what was asked for.
void report_samples(const host::RenderStatistics& statistics, const host::RenderSettings& settings,
                    const Enough& enough, Diagnostics& diagnostics);

/// "12 to 64 of 64 samples a pixel"
std::string samples_text(const host::RenderStatistics& statistics,
                         const host::RenderSettings& settings);

}  // namespace nacre::tool
