#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jit/tune/choices.h"
#include "jit/tune/error.h"
#include "jit/tune/recorded_points.h"
#include "jit/tune/trial.h"
#include "runtime/stop.h"

namespace nacre {

/// How a subject is to be tuned.
struct TuneOptions {
  double max_error = 0.01;
  /// Of what may be max_error; `max_error` by this metric.
  Metric metric;
  std::size_t points = 2048;
  /// Of materials, in place of these: where a renderer has shaded them. Null: none.
  std::shared_ptr<const RecordedPoints> recorded;
  /// What holds whatever is chosen: limits, search paths, the graph's options.
  ShaderOptions shader;
  double seconds_a_kernel = 0.05;  ///< To time it; 0: nothing is timed.
  /// Due: no more ways are tried, and nothing more is timed; the cheapest is of those that were.
  /// Then it depends on the machine.
  Stop enough;
  std::function<void(double share)> progress;
};

/// One way of compiling, measured.
struct Candidate {
  Choices choices;
  Digest programs{};                  ///< TuneTrial::digest()
  double cost = 0;                    ///< See TuneTrial::cost().
  Error error;                        ///< At the points by which one is chosen.
  std::optional<Error> unseen_error;  ///< At others; of what was considered for being chosen.
  double nanoseconds = 0;             ///< 0: not timed.
};

struct Tuned {
  /// None is both cheaper and more exact; the most exact first. Then what was chosen, if it is not
  /// of them.
  std::vector<Candidate> front;
  Candidate chosen;
  Candidate standard;         ///< What is compiled where nothing is said.
  std::string points;         ///< Where errors were measured, for people.
  bool is_cut_short = false;  ///< TuneOptions::enough was due before all was tried.
};

/// The cheapest way to compile a subject that is no more than max_error from a computation in
/// double precision with everything exact: for 999 of 1000 numbers, and 3 max_error for each; at
/// points by which it is chosen, and again at points by which it is not. The same on every machine:
/// how long it takes is told, and not decided by. Nothing, with a diagnostic, where no way is
/// exact enough, where it cannot be compiled, or where options.shader.compile.stop is due.
std::optional<Tuned> tune(const TuneSubject& subject, const TuneOptions& options,
                          Diagnostics& diagnostics);

}  // namespace nacre
