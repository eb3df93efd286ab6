#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pbs/edf.h"
#include "pbs/facets.h"
#include "pbs/profile/ies.h"
#include "pbs/profile/sample_profile.h"
#include "pbs/sampling.h"
#include "runtime/node/geometry.h"

namespace nacre {

namespace {

/// Measured angles as a kernel finds its place among them: equal steps, none longer than the
/// shortest way from one angle to the next, each with the last angle before it.
class AngleTable {
 public:
  AngleTable(Recorder& recorder, const char* name, std::vector<float> angles)
      : recorder_(recorder), angles_(std::move(angles)) {
    float shortest = angles_.back() - angles_.front();
    for (std::size_t i = 1; i < angles_.size(); ++i) {
      shortest = std::min(shortest, angles_[i] - angles_[i - 1]);
    }
    const float range = angles_.back() - angles_.front();
    steps_ = static_cast<int>(std::ceil(range / shortest));
    std::vector<float> before;
    for (int step = 0; step < steps_; ++step) {
      const float from = angles_.front() + range * (float(step) / float(steps_));
      const auto next = std::upper_bound(angles_.begin() + 1, angles_.end() - 1, from);
      before.push_back(static_cast<float>(next - angles_.begin() - 1));
    }
    knots_ = recorder.table(std::string("profile.") + name, angles_);
    before_ = recorder.table(std::string("profile.before_") + name, before);
  }

  struct Place {
    Int first;       ///< An angle that is not the last one.
    Float fraction;  ///< From it to the next, in [0, 1].
    Bool measured;   ///< Neither before the first nor behind the last.
  };
  Place find(Float angle) const {
    const float front = angles_.front(), back = angles_.back();
    const Float along = saturate((angle - front) * (1.0f / (back - front)));
    const Float step = min(floor(along * float(steps_)), float(steps_ - 1));
    const Int low = to_int(at(before_, to_int(step)));
    const Int last(static_cast<std::int32_t>(angles_.size()) - 2);
    const Int first = select(angle >= at(knots_, low + Int(1)), min(low + Int(1), last), low);
    const Float from = at(knots_, first), to = at(knots_, first + Int(1));
    return {.first = first,
            .fraction = saturate((angle - from) / (to - from)),
            .measured = (angle >= front) & (angle <= back)};
  }

 private:
  Float at(std::uint32_t table, Int index) const {
    const std::array<Ref, 1> operand{index.ref()};
    return Float(recorder_.emit(Op::table, operand, table));
  }

  Recorder& recorder_;
  std::vector<float> angles_;
  int steps_ = 1;
  std::uint32_t knots_ = 0, before_ = 0;
};

struct Angles {
  Float vertical, horizontal;  ///< In degrees.
};

/// Where w, of components along the profile's x, y and z, stands on its axes.
Angles angles_of(LightProfile::Type type, Float3 w) {
  constexpr float degrees = 180.0f / pi;
  // By two components, for the cosine alone has no digits about an axis.
  const auto across = [](Float a, Float b) { return sqrt(fma(a, a, square(b))); };
  if (type == LightProfile::Type::c) {
    const Float around = atan2(w.y, w.x) * degrees;
    return {atan2(across(w.x, w.y), w.z) * degrees, select(around < 0.0f, around + 360.0f, around)};
  }
  if (type == LightProfile::Type::b) {
    return {atan2(w.y, w.z) * degrees, atan2(w.x, across(w.y, w.z)) * degrees};
  }
  return {atan2(w.y, across(w.x, w.z)) * degrees, atan2(w.x, w.z) * degrees};
}

/// Into what was measured, by the symmetries of LM-63-2002.
Angles folded(const LightProfile& profile, Angles at) {
  if (profile.type != LightProfile::Type::c) {
    if (profile.vertical.front() == 0.0f) at.vertical = abs(at.vertical);
    if (profile.horizontal.front() == 0.0f) at.horizontal = abs(at.horizontal);
    return at;
  }
  const float first = profile.horizontal.front(), last = profile.horizontal.back();
  Float& around = at.horizontal;
  if (first == 90.0f) {  // Alike on both sides of the plane from 90 to 270.
    around = select(around < 90.0f, 180.0f - around, around);
    around = select(around > 270.0f, 540.0f - around, around);
  } else if (last <= 180.0f) {
    around = select(around > 180.0f, 360.0f - around, around);
    if (last == 90.0f) around = select(around > 90.0f, 180.0f - around, around);
  }
  return at;
}

class MeasuredEdf final : public Emitter {
 public:
  /// `profile`: relative().
  MeasuredEdf(Color3 color, Float3 normal, Float3 tangent, LightProfile profile)
      : color_(color), normal_(normal), tangent_(tangent), profile_(std::move(profile)) {}

  Color3 radiance(const View& view, Color3, Color3) const override {
    if (is_zero(color_)) return color_;
    return color_ * Color3(look_up(*view.recorder, frame().to_local(view.wo)));
  }

  Color3 power() const override {
    return power_seen(color_, Color3(tables().total > 0.0 ? 2.0f * pi : 0.0f));
  }
  Float3 sample(const View& view, Float3 u) const override {
    if (tables().total == 0.0) return normal_;
    return frame().to_world(sample_profile(*view.recorder, profile_, tables(), u));
  }
  Float pdf(const View& view) const override {
    if (tables().total == 0.0) return 0.0f;
    const Float3 local = frame().to_local(view.wo);
    return look_up(*view.recorder, local) * profile_weight(profile_.type, local) *
           Float(1.0 / tables().total);
  }

 private:
  bool is_ring() const { return profile_.horizontal.size() == 1; }
  Frame frame() const { return is_ring() ? make_frame(normal_) : make_frame(normal_, tangent_); }

  Float look_up(Recorder& recorder, Float3 local) const {
    const auto rows = static_cast<std::int32_t>(profile_.vertical.size());
    const std::uint32_t table = recorder.table("profile.intensity", profile_.intensity);
    const Angles at = folded(profile_, angles_of(profile_.type, local));
    const auto v = AngleTable(recorder, "vertical", profile_.vertical).find(at.vertical);
    const auto column = [&](Int first) {
      const auto value = [&](Int row) {
        const std::array<Ref, 1> operand{(first + row).ref()};
        return Float(recorder.emit(Op::table, operand, table));
      };
      return lerp(value(v.first), value(v.first + Int(1)), v.fraction);
    };
    if (is_ring()) return select(v.measured, column(Int(0)), 0.0f);
    const auto h = AngleTable(recorder, "horizontal", profile_.horizontal).find(at.horizontal);
    const Float found =
        lerp(column(h.first * Int(rows)), column((h.first + Int(1)) * Int(rows)), h.fraction);
    return select(v.measured & h.measured, found, 0.0f);
  }

  /// Made where somebody samples; the recorder's thread is the only one.
  const ProfileTables& tables() const {
    if (!tables_) tables_ = make_profile_tables(profile_);
    return *tables_;
  }

  Color3 color_;
  Float3 normal_, tangent_;
  LightProfile profile_;
  mutable std::optional<ProfileTables> tables_;
};

/// With radiance in place of candela, over that of a surface that emits as much in all directions
/// alike.
LightProfile relative(LightProfile profile) {
  const double all = emittance(profile);
  // A surface of radiance 1 emits pi from each side. What is dark is so by zeros.
  const double scale = all > 0.0 ? 2.0 * std::numbers::pi / all : 0.0;
  for (float& value : profile.intensity) value = static_cast<float>(value * scale);
  return profile;
}

/// relative(); nothing, said, where there is none.
std::optional<LightProfile> read_profile(NodeCall& call) {
  TextureProvider* const files = call.textures();
  const std::string& name = call.text("file");
  if (files == nullptr || name.empty()) return std::nullopt;
  const std::optional<std::string> text = files->read(name);
  if (!text) return std::nullopt;
  IesFault fault;
  std::optional<LightProfile> profile = parse_ies(*text, fault);
  if (profile) return relative(std::move(*profile));
  Diagnostics problems;
  problems.error("bad-light-profile", {name, 0, 0, {}},
                 "line " + std::to_string(fault.line) + ": " + fault.message, fault.expected,
                 fault.found);
  files->complain(problems);
  return std::nullopt;
}

}  // namespace

/// measured_edf. MaterialX PBS 1.39: the light of an IES profile. Where the text is silent: the
/// main axis of the luminaire is the normal and its x the tangent; the radiance has the shape of
/// the measured intensity, and the surface emits from both its sides together as much as
/// uniform_edf of that colour does, whatever candela the file has. Without a file, that is what it
/// is. Components below zero, and NaN, count as zero.
void record_closure_measured_edf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const Color3 color = keep(recorder, max(call.vector3("color"), Color3(0.0f)));
  const Float3 normal = prepare_normal(recorder, call.vector3("normal"));
  std::optional<LightProfile> profile = read_profile(call);
  if (!profile) return call.set(uniform_edf(color));
  call.set(std::make_shared<MeasuredEdf>(color, normal, tangent(recorder, Space::world),
                                         std::move(*profile)));
}

}  // namespace nacre
