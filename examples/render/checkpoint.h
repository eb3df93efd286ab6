#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "examples/render/render_counts.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// What a render has done so far, in a file. Of one kind of machine: numbers are as it has them.
class Checkpoint {
 public:
  struct Content {
    std::vector<int> done;  ///< Samples by tile.
    RenderCounts counts;    ///< Of those.
    std::string sums;       ///< Of Accumulation.
  };

  /// `key`: says what is rendered; a file that another key is in is of another render.
  Checkpoint(std::string file, std::string key, double every_seconds)
      : file_(std::move(file)), key_(std::move(key)), every_(every_seconds) {}

  /// What the file has; empty where there is none. An error where it is of something else, broken,
  /// or cannot be read.
  Content load(Diagnostics& diagnostics) const;
  /// Whether it is time to.
  bool is_due() const;
  /// `append`: adds the sums. False with an error; the file is then as it was.
  bool save(const std::vector<int>& done, const RenderCounts& counts,
            const std::function<void(std::string&)>& append, Diagnostics& diagnostics);

 private:
  using Clock = std::chrono::steady_clock;
  std::string file_, key_;
  std::chrono::duration<double> every_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace nacre::host
