#include "jit/record/text_lobe.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jit/record/text_fit.h"
#include "jit/record/text_lobe_functions.h"
#include "pbs/bsdf.h"
#include "pbs/facets.h"
#include "pbs/per_view.h"

namespace nacre {

namespace {

/// On which sides of the surface, seen from the viewer's, a lobe scatters.
struct Sides {
  bool reflects = false, transmits = false;
};

std::optional<Sides> parse_sides(std::string_view text) {
  if (text.empty() || text == "R") return Sides{true, false};
  if (text == "T") return Sides{false, true};
  if (text == "RT") return Sides{true, true};
  return std::nullopt;
}

glsl::Value value_of(Float3 v) {
  return {glsl::float_type.with_rows(3), {v.x.ref(), v.y.ref(), v.z.ref()}, {}};
}
Float3 three(const glsl::Value& value) {
  return {value.number(0), value.number(1), value.number(2)};
}

/// A lobe whose functions are a text's. Held to what Lobe promises, whatever numbers they give:
/// what is negative or no number is 0, f and pdf are no more than `most` and f is 0 where pdf
/// is, so that their ratios are finite; samples are unit vectors.
class TextLobe final : public Lobe {
 public:
  struct Frames {
    Float3 normal;
    std::optional<Float3> tangent;
  };

  TextLobe(std::string_view name, Sides sides, LobeFunctions functions, Frames frames,
           TextLobeOptions options, const std::string& path, Diagnostics& diagnostics)
      : name_(name),
        sides_(sides),
        functions_(std::move(functions)),
        frames_(std::move(frames)),
        options_(std::move(options)),
        path_(path),
        diagnostics_(diagnostics) {}

  std::string_view name() const override { return name_; }
  std::int32_t kinds() const override {
    const bool is_glossy = functions_.roughness.function != nullptr;
    const std::int32_t reflection = is_glossy ? lobe_glossy_reflection : lobe_diffuse_reflection;
    const std::int32_t transmission =
        is_glossy ? lobe_glossy_transmission : lobe_diffuse_transmission;
    return (sides_.reflects ? reflection : 0) | (sides_.transmits ? transmission : 0);
  }

  void prepare(const View& view, Bool mask) const override {
    light_.prepare(view, mask, [&] { return compute_light(view); });
  }

  LobeValue evaluate(const View& view, Float3 wi_world) const override {
    const Frame frame = frame_of(view);
    const Float3 wo = seen_from(frame, view);
    const Float3 wi = frame.to_local(wi_world);
    Bool is_asked = is_on_side(wi.z);
    if (options_.is_held) is_asked = is_asked & is_unit(wi);
    const LobeValue none{.f = Color3(0.0f), .pdf = 0.0f};
    return if_any(is_asked, none, [&] {
      Recorder& recorder = *view.recorder;
      const std::vector<glsl::Value> directions{value_of(wo), value_of(wi)};
      const Float pdf = call(functions_.pdf, recorder, directions).number(0);
      const Color3 f = three(call(functions_.evaluate, recorder, directions));
      return options_.is_held ? held(f, pdf) : LobeValue{.f = f, .pdf = pdf};
    });
  }

  LobeSample sample(const View& view, Float3 u) const override {
    const Frame frame = frame_of(view);
    const glsl::Type& wanted = functions_.sample.function->parameters[1].type;
    glsl::Value xi{wanted, {u.x.ref(), u.y.ref(), u.z.ref()}, {}};
    xi.parts.resize(wanted.rows);
    const Float3 wi = three(
        call(functions_.sample, *view.recorder, {value_of(seen_from(frame, view)), std::move(xi)}));
    const Bool is_there =
        options_.is_held ? is_unit(wi) : (wi.x != 0.0f) | (wi.y != 0.0f) | (wi.z != 0.0f);
    return {.wi = frame.to_world(wi), .valid = is_there & is_on_side(wi.z)};
  }
  bool checks_samples() const override { return true; }

  Color3 albedo(const View& view) const override { return saturate(light(view)); }
  Color3 light(const View& view) const override {
    return light_.get(view, [&] { return compute_light(view); }).color;
  }
  Color3 throughput(const View& view) const override {
    if (functions_.throughput.function == nullptr) return Color3(1.0f) - albedo(view);
    const glsl::Value wo = value_of(seen_from(frame_of(view), view));
    return saturate(three(call(functions_.throughput, *view.recorder, {wo})));
  }
  Float3 normal(const View&) const override { return frames_.normal; }
  Float roughness(const View& view) const override {
    if (functions_.roughness.function == nullptr) return 1.0f;
    return saturate(call(functions_.roughness, *view.recorder, {}).number(0));
  }

 private:
  /// Beyond what the sharpest lobe is worth asking for; a ratio of two such numbers is finite, with
  /// the weights that stand before it too.
  static constexpr float most = 1e12f;

  struct Light {
    Color3 color;
    template <class F>
    friend void visit(Light& light, F&& f) {
      nacre::visit(light.color, f);
    }
  };

  static LobeValue held(Color3 f, Float pdf) {
    const Float density = min(max(pdf, 0.0f), most);
    const Bool counts = density >= 1.0f / most;
    const auto one = [&](Float x) { return select(counts, min(max(x, 0.0f), most), 0.0f); };
    return {.f = {one(f.x), one(f.y), one(f.z)}, .pdf = select(counts, density, 0.0f)};
  }

  Light compute_light(const View& view) const {
    const glsl::Value wo = value_of(seen_from(frame_of(view), view));
    const Color3 said = three(call(functions_.albedo, *view.recorder, {wo}));
    return {min(max(said, Color3(0.0f)), Color3(1e6f))};
  }

  Frame frame_of(const View& view) const {
    if (!frames_.tangent) return facing_frame(frames_.normal, view.wo);
    return make_frame(facing(frames_.normal, view.wo), *frames_.tangent);
  }
  static Float3 seen_from(const Frame& frame, const View& view) {
    Float3 wo = frame.to_local(view.wo);
    wo.z = min(abs(wo.z), 1.0f);
    return wo;
  }
  Bool is_on_side(Float z) const {
    if (sides_.reflects && sides_.transmits) return (z > 0.0f) | (z < 0.0f);
    return sides_.reflects ? z > 0.0f : z < 0.0f;
  }

  glsl::Value call(const LobeFunction& function, Recorder& recorder,
                   std::vector<glsl::Value> arguments) const {
    arguments.insert(arguments.end(), function.inputs.begin(), function.inputs.end());
    Diagnostics found;
    auto result = functions_.module->record(*function.function, std::move(arguments), recorder,
                                            found, {}, options_.limits);
    say_once(path_, found, diagnostics_);
    if (!result) throw LobeFailure{};
    return std::move(result->value);
  }

  const std::string name_;
  const Sides sides_;
  const LobeFunctions functions_;
  const Frames frames_;
  const TextLobeOptions options_;
  const std::string path_;  ///< Of the implementation.
  Diagnostics& diagnostics_;
  PerView<Light> light_;
};

}  // namespace

bool set_text_lobe(const NodeText& source, std::shared_ptr<const glsl::Module> module,
                   NodeCall& call, const TextLobeOptions& options, Diagnostics& diagnostics) {
  if (source.function.empty()) {
    return misfit(source.where, diagnostics, "a lobe needs the name of its functions",
                  "function=\"NAME\", for NAME_evaluate, NAME_sample, NAME_pdf and NAME_albedo",
                  "an expression");
  }
  if (call.outputs().size() != 1) {
    return misfit(source.where, diagnostics, "a node that is a lobe has nothing else", "one output",
                  fmt::format("{} outputs", call.outputs().size()));
  }
  const auto sides = parse_sides(source.sides);
  if (!sides) {
    return misfit(source.where, diagnostics, "the nodedef's `bsdf` names no sides", "R, T or RT",
                  source.sides);
  }
  auto functions = find_lobe_functions(source, std::move(module), call, diagnostics);
  if (!functions) return false;
  Recorder& recorder = call.recorder();
  bool has_weight = false;
  TextLobe::Frames frames;
  std::optional<Float3> normal;
  for (const NodeCall::Port& input : call.inputs()) {
    if (!is_for_kernel(input)) continue;
    if (input.name == "weight") has_weight = true;
    if (input.name == "normal") normal = call.vector3("normal");
    if (input.name == "tangent") frames.tangent = keep(recorder, call.vector3("tangent"));
  }
  frames.normal =
      prepare_facing_normal(recorder, normal ? *normal : nacre::normal(recorder, Space::world));
  auto lobe =
      std::make_shared<TextLobe>(call.category(), *sides, std::move(*functions), std::move(frames),
                                 options, source.where.path, call.diagnostics());
  if (has_weight) {
    set_lobe(call, std::move(lobe));
  } else {
    call.set(std::make_shared<LobeBsdf>(std::move(lobe), Float(1.0f), recorder.origin()));
  }
  return true;
}

bool try_text_lobe(Recorder& recorder, const NodeCall& call) {
  const BsdfPtr bsdf = as_bsdf(call.outputs().front().value.closure);
  const Lobe& lobe = *bsdf->leaf()->lobe();
  View view;
  view.recorder = &recorder;
  view.wo = view_direction(recorder);
  try {
    lobe.evaluate(view, channel3(recorder, "wi"));
    lobe.sample(view, channel3(recorder, "u"));
    lobe.albedo(view);
    lobe.throughput(view);
    lobe.roughness(view);
  } catch (const LobeFailure&) {
    return false;
  }
  return true;
}

}  // namespace nacre
