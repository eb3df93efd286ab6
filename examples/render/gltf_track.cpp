#include "examples/render/gltf_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "examples/render/motion.h"

namespace nacre::host {

namespace {

using Value = GltfTrack::Value;

double dot4(const Value& a, const Value& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

Value mix(const Value& a, const Value& b, double s) {
  if (a == b) return a;  // Without a rounding: what stands still stays where it is.
  Value result{};
  for (std::size_t i = 0; i < 4; ++i) result[i] = (1 - s) * a[i] + s * b[i];
  return result;
}

Value unit(Value q) {
  const double size = std::sqrt(dot4(q, q));
  for (double& each : q) each /= size;
  return q;
}

/// Between unit quaternions, the short way.
double angle_between(const Value& a, const Value& b) {
  return std::acos(std::min(std::abs(dot4(a, b)), 1.0));
}

/// glTF 2.0, Appendix C.4.
Value slerp(const Value& a, Value b, double s) {
  if (a == b) return a;
  const Value from = unit(a);
  b = unit(b);
  const double angle = angle_between(from, b);
  if (dot4(from, b) < 0) {
    for (double& each : b) each = -each;
  }
  if (angle < 1e-6) return mix(from, b, s);
  Value result{};
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] =
        (std::sin((1 - s) * angle) * from[i] + std::sin(s * angle) * b[i]) / std::sin(angle);
  }
  return result;
}

std::optional<GltfAccessor> open(GltfAccessors& accessors, const GltfValue& index, int components) {
  const auto a = accessors.attribute(index.need("the index of an accessor"), components);
  if (!a || a->components == components) return a;
  index.error("the accessor has another type than its sampler needs",
              fmt::format("{} components", components), fmt::format("{}", a->components));
  return {};
}

bool check_times(const GltfValue& input, const std::vector<float>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    const float before = i == 0 ? -INFINITY : times[i - 1];
    if (std::isfinite(times[i]) && times[i] > before) continue;
    input.error("the times of the sampler do not ascend", "each greater than the one before",
                fmt::format("{:g} after {:g}", times[i], before));
    return false;
  }
  return true;
}

bool check_values(const GltfValue& output, const std::vector<float>& values, std::size_t parts) {
  const auto bad = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
  if (bad != values.end()) {
    output.error("a value of the sampler is not finite", "finite numbers",
                 fmt::format("{:g}", *bad));
    return false;
  }
  if (parts == 0) return true;
  const std::size_t middle = parts / 2;  // Of in-tangent, value and out-tangent the value.
  for (std::size_t k = middle; 4 * k < values.size(); k += parts) {
    if (std::any_of(&values[4 * k], &values[4 * k] + 4, [](float q) { return q * q > 0.f; })) {
      continue;
    }
    output.error("a rotation has no axis", "unit quaternions", "zeros");
    return false;
  }
  return true;
}

}  // namespace

/// `elements`: how many the accessor has for each value.
std::unique_ptr<GltfTrack> GltfTrack::read_all(const GltfValue& sampler, std::size_t components,
                                               std::size_t elements, GltfAccessors& accessors,
                                               SceneBudget& budget) {
  auto track = std::make_unique<GltfTrack>();
  track->components_ = components;
  const std::string kind =
      sampler["interpolation"] ? sampler["interpolation"].text().value_or("") : "LINEAR";
  if (kind == "STEP") {
    track->interpolation_ = Interpolation::step;
  } else if (kind == "CUBICSPLINE") {
    track->interpolation_ = Interpolation::cubic;
  } else if (kind != "LINEAR") {
    sampler["interpolation"].error("there is no such interpolation",
                                   "\"LINEAR\", \"STEP\" or \"CUBICSPLINE\"",
                                   sampler["interpolation"].shown());
    return nullptr;
  }
  const GltfValue input = sampler["input"], output = sampler["output"];
  const auto times = open(accessors, input, 1);
  const auto values = open(accessors, output, static_cast<int>(components));
  if (!times || !values) return nullptr;
  const std::size_t parts = elements * track->parts();
  if (values->count % parts != 0 || values->count / parts != times->count) {
    output.error("the sampler has another number of values than its times need",
                 fmt::format("{} for each of {} times", parts, times->count),
                 fmt::format("{}", values->count));
    return nullptr;
  }
  const std::size_t bytes =
      4 * (times->count + values->count * static_cast<std::size_t>(values->components));
  if (!budget.take_bytes(sampler.location(), bytes)) return nullptr;
  track->times_ = GltfAccessors::floats(*times);
  track->values_ = GltfAccessors::floats(*values);
  const bool ok = check_times(input, track->times_) &&
                  check_values(output, track->values_, components == 4 ? parts : 0);
  return ok ? std::move(track) : nullptr;
}

std::unique_ptr<GltfTrack> GltfTrack::read(const GltfValue& sampler, bool is_rotation,
                                           GltfAccessors& accessors, SceneBudget& budget) {
  auto track = read_all(sampler, is_rotation ? 4 : 3, 1, accessors, budget);
  if (track != nullptr) track->is_rotation_ = is_rotation;
  return track;
}

std::vector<std::unique_ptr<GltfTrack>> GltfTrack::read_weights(const GltfValue& sampler,
                                                                std::size_t count,
                                                                GltfAccessors& accessors,
                                                                SceneBudget& budget) {
  std::vector<std::unique_ptr<GltfTrack>> list;
  const auto all = read_all(sampler, 1, count, accessors, budget);
  if (all == nullptr) return list;
  const std::size_t bytes = 4 * (all->times_.size() * count + all->values_.size());
  if (!budget.take_bytes(sampler.location(), bytes)) return list;
  for (std::size_t k = 0; k < count; ++k) {
    auto& track = list.emplace_back(std::make_unique<GltfTrack>());
    track->interpolation_ = all->interpolation_;
    track->components_ = 1;
    track->times_ = all->times_;
    for (std::size_t i = k; i < all->values_.size(); i += count) {
      track->values_.push_back(all->values_[i]);
    }
  }
  return list;
}

/// The last key that is not behind the time; the first, where all are.
std::size_t GltfTrack::key_before(double time) const {
  const auto behind = std::ranges::upper_bound(times_, time, {}, [](float t) { return double{t}; });
  return behind == times_.begin() ? 0 : static_cast<std::size_t>(behind - times_.begin()) - 1;
}

/// `part` 0, 1 and 2 of a cubic: in-tangent, value, out-tangent.
GltfTrack::Value GltfTrack::key(std::size_t i, int part) const {
  const bool is_cubic = interpolation_ == Interpolation::cubic;
  const std::size_t place = is_cubic ? 3 * i + static_cast<std::size_t>(part) : i;
  Value value{};
  for (std::size_t c = 0; c < components_; ++c) {
    value[c] = static_cast<double>(values_[place * components_ + c]);
  }
  return value;
}

/// glTF 2.0, Appendix C.5.
GltfTrack::Value GltfTrack::cubic(std::size_t i, double s) const {
  const double span = static_cast<double>(times_[i + 1]) - static_cast<double>(times_[i]);
  const double s2 = s * s, s3 = s2 * s;
  const Value a = key(i), b = key(i + 1), out = key(i, 2), in = key(i + 1, 0);
  Value value{};
  for (std::size_t c = 0; c < 4; ++c) {
    value[c] = (2 * s3 - 3 * s2 + 1) * a[c] + span * (s3 - 2 * s2 + s) * out[c] +
               (3 * s2 - 2 * s3) * b[c] + span * (s3 - s2) * in[c];
  }
  return is_rotation_ && !(dot4(value, value) > 1e-12) ? a : value;
}

GltfTrack::Value GltfTrack::at(double time, double within) const {
  const std::size_t i = key_before(within);
  if (i + 1 == times_.size() || within < static_cast<double>(times_.front())) return key(i);
  const double from = static_cast<double>(times_[i]), to = static_cast<double>(times_[i + 1]);
  const double share = std::clamp((time - from) / (to - from), 0.0, 1.0);
  switch (interpolation_) {
    case Interpolation::step: return key(i);
    case Interpolation::cubic: return cubic(i, share);
    case Interpolation::linear: break;
  }
  return is_rotation_ ? slerp(key(i), key(i + 1), share) : mix(key(i), key(i + 1), share);
}

int GltfTrack::steps(double from, double to) const {
  constexpr int least_of_curves = 32;
  const double within = 0.5 * (from + to);
  const Value a = at(from, within), b = at(to, within);
  const int turn = is_rotation_ ? steps_for_angle(2 * angle_between(unit(a), unit(b))) : 1;
  const bool bends = interpolation_ == Interpolation::cubic && from != to;
  return bends ? std::max(turn, least_of_curves) : turn;
}

}  // namespace nacre::host
