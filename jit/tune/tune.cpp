#include "jit/tune/tune.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "jit/tune/dimension.h"
#include "jit/tune/examination.h"
#include "runtime/report_stop.h"

namespace nacre {

namespace {

/// Of one that exceeds `max_error` this is still allowed.
constexpr double most_at_a_point = 3;

/// At how many points costs are counted.
constexpr std::size_t counted_points = 128;

/// The first of them.
TunePoints first_of(const TunePoints& points, std::size_t count) {
  TunePoints first = points;
  first.set.count = std::min(count, points.set.count);
  return first;
}

std::size_t steps(const Choices& choices) {
  return std::accumulate(choices.begin(), choices.end(), std::size_t{0});
}

/// What is cheaper comes first; of two that cost the same the one that asks for less.
bool is_cheaper(const Candidate& a, const Candidate& b) {
  if (a.cost != b.cost) return a.cost < b.cost;
  if (steps(a.choices) != steps(b.choices)) return steps(a.choices) > steps(b.choices);
  return a.choices < b.choices;
}

class Tuner {
 public:
  Tuner(const TuneSubject& subject, const TuneOptions& options, Diagnostics& diagnostics)
      : subject_(subject), options_(options), diagnostics_(diagnostics) {}

  std::optional<Tuned> run() {
    const auto exactly = compile_exactly(subject_, options_.shader, diagnostics_);
    has_said_ = true;
    if (exactly == nullptr || !examine(*exactly, 0, seen_) || !examine(*exactly, 1, unseen_) ||
        !measure_all()) {
      return std::nullopt;
    }
    Tuned tuned;
    tuned.points = unseen_.about;
    tuned.front = front();
    const Candidate* const standard = measured(standard_choices());
    if (standard == nullptr) return std::nullopt;
    tuned.standard = *standard;
    if (!verify(tuned.standard) || !choose(tuned)) return std::nullopt;
    if (options_.seconds_a_kernel > 0 && !time(tuned)) return std::nullopt;
    tuned.is_cut_short = is_cut_short_;
    report(1);
    return tuned;
  }

 private:
  std::unique_ptr<TuneTrial> compile(const Choices& choices, Backend backend) {
    if (options_.shader.compile.stop.is_due()) return nullptr;
    ShaderOptions options = options_.shader;
    apply_choices(choices, options);
    options.compile.backend = backend;
    options.compile.asynchronous = false;
    // What is said of the document is said of each trial; once is enough.
    Diagnostics said;
    auto trial = TuneTrial::compile(subject_, options, said);
    if (trial == nullptr || std::exchange(has_said_, true) == false) {
      for (const Diagnostic& each : said.all()) diagnostics_.add(each);
    }
    return trial;
  }

  bool examine(const TuneTrial& exactly, std::uint32_t number, Examination& made) {
    auto done = nacre::examine(subject_, exactly, options_.points, options_.recorded.get(), number,
                               diagnostics_);
    if (done) made = std::move(*done);
    return done.has_value();
  }

  /// What a trial of these choices gives; null where it cannot be compiled.
  const Candidate* measured(const Choices& choices) {
    if (const auto known = candidates_.find(choices); known != candidates_.end()) {
      return &known->second;
    }
    // Interpreted: the same bits as compiled, at once.
    const auto trial = compile(choices, Backend::interpreter);
    if (trial == nullptr) return nullptr;
    Candidate& made = of_programs_[trial->digest()];
    if (made.choices.empty()) {
      made.programs = trial->digest();
      made.cost = trial->cost(first_of(seen_.points, counted_points));
      made.error = error_at(*trial, seen_);
      if (trial->is_stopped()) return nullptr;
    }
    made.choices = choices;
    return &candidates_.emplace(choices, made).first->second;
  }

  Error error_at(const TuneTrial& trial, const Examination& at) const {
    return error_of(trial.results(at.points), at.exact, options_.metric);
  }

  /// From what is exact, always the step that costs the least exactness, to what is cheapest.
  bool measure_all() {
    Choices at = exact_choices();
    if (measured(at) == nullptr || measured(standard_choices()) == nullptr) return false;
    const std::vector<std::size_t> useful = useful_dimensions();
    const auto all = static_cast<double>(steps(cheapest(useful)));
    while (true) {
      const Candidate* best = nullptr;
      for (const std::size_t i : useful) {
        if (at[i] + 1 == dimensions()[i].settings.size()) continue;
        if (is_enough()) return true;
        Choices next = at;
        ++next[i];
        const Candidate* const candidate = measured(next);
        if (candidate == nullptr) return false;
        if (best == nullptr || candidate->error.p999 < best->error.p999) best = candidate;
      }
      if (best == nullptr) return true;
      at = best->choices;
      report(0.8 * static_cast<double>(steps(at)) / all);
    }
  }

  /// Those that change what is computed at all.
  std::vector<std::size_t> useful_dimensions() {
    std::vector<std::size_t> useful;
    for (std::size_t i = 0; i < dimensions().size() && !is_enough(); ++i) {
      if (changes(i, exact_choices()) || changes(i, standard_choices())) useful.push_back(i);
    }
    return useful;
  }

  /// Whether the cheapest setting of a dimension gives other Programs than `from`.
  bool changes(std::size_t dimension, const Choices& from) {
    Choices choices = from;
    choices[dimension] = dimensions()[dimension].settings.size() - 1;
    const Candidate* const cheapest = choices == from ? nullptr : measured(choices);
    const Candidate* const before = measured(from);
    if (cheapest == nullptr || before == nullptr) return false;
    if (cheapest->programs != before->programs) return true;
    candidates_.erase(choices);  // Lest something be asked for that changes nothing.
    return false;
  }

  static Choices cheapest(const std::vector<std::size_t>& useful) {
    Choices choices = exact_choices();
    for (const std::size_t i : useful) choices[i] = dimensions()[i].settings.size() - 1;
    return choices;
  }

  std::vector<Candidate> front() const {
    std::vector<Candidate> all;
    for (const auto& [choices, candidate] : candidates_) all.push_back(candidate);
    std::ranges::sort(all, is_cheaper);
    std::vector<Candidate> front;
    for (const Candidate& each : all) {
      if (!front.empty() && each.error.p999 >= front.back().error.p999) continue;
      if (!front.empty() && each.cost == front.back().cost) front.pop_back();
      front.push_back(each);
    }
    std::ranges::reverse(front);
    return front;
  }

  bool keeps(const Error& error) const {
    return error.p999 <= options_.max_error &&
           error.maximum <= most_at_a_point * options_.max_error;
  }

  bool verify(Candidate& candidate) {
    const auto trial = compile(candidate.choices, Backend::interpreter);
    if (trial == nullptr) return false;
    candidate.unseen_error = error_at(*trial, unseen_);
    return !trial->is_stopped();
  }

  bool choose(Tuned& tuned) {
    std::vector<Candidate> kept;
    for (const auto& [choices, candidate] : candidates_) {
      if (keeps(candidate.error)) kept.push_back(candidate);
    }
    std::ranges::sort(kept, is_cheaper);
    for (Candidate& each : kept) {
      if (!verify(each)) return false;
      if (!keeps(*each.unseen_error)) continue;
      tuned.chosen = each;
      return true;
    }
    const Candidate* const exact = measured(exact_choices());
    if (exact == nullptr) return false;
    const Error& least = exact->error;
    diagnostics_.error("no-such-error", {.file = {}, .path = subject_.text()},
                       "no way to compile this is so exact",
                       fmt::format("an error of {}", options_.max_error),
                       fmt::format("{:.3g}, at most {:.3g} (in {} at point {})", least.p999,
                                   least.maximum, least.worst, least.worst_point));
    return false;
  }

  bool time(Tuned& tuned) {
    std::vector<Candidate*> all;
    for (Candidate& each : tuned.front) all.push_back(&each);
    all.push_back(&tuned.chosen);
    all.push_back(&tuned.standard);
    std::map<Digest, double> known;
    for (std::size_t i = 0; i < all.size() && !is_enough(); ++i) {
      report(0.8 + 0.2 * static_cast<double>(i) / static_cast<double>(all.size()));
      double& found = known[all[i]->programs];
      if (found == 0) {
        const auto trial = compile(all[i]->choices, Backend::jit);
        if (trial == nullptr) return false;
        found = trial->nanoseconds(seen_.points, options_.seconds_a_kernel);
      }
      all[i]->nanoseconds = found;
    }
    return true;
  }

  bool is_enough() {
    if (options_.enough.is_due()) is_cut_short_ = true;
    return is_cut_short_;
  }

  void report(double share) const {
    if (options_.progress) options_.progress(share);
  }

  const TuneSubject& subject_;
  const TuneOptions& options_;
  Diagnostics& diagnostics_;
  bool has_said_ = false;
  bool is_cut_short_ = false;
  Examination seen_, unseen_;
  std::map<Choices, Candidate> candidates_;
  std::map<Digest, Candidate> of_programs_;  ///< What was measured of each; the latest choices.
};

}  // namespace

std::optional<Tuned> tune(const TuneSubject& subject, const TuneOptions& options,
                          Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  auto tuned = Tuner(subject, options, diagnostics).run();
  if (!tuned && diagnostics.error_count() == errors_before) {
    report_if_due(options.shader.compile.stop, "choosing how exact kernels are",
                  {.file = {}, .path = subject.text()}, diagnostics);
  }
  return tuned;
}

}  // namespace nacre
