#include "jit/shading/state_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "jit/compile/lower.h"

namespace nacre {

namespace {

constexpr std::string_view state_prefix = "state.";

bool is_state(const std::string& name) { return std::string_view(name).starts_with(state_prefix); }

/// Of each point, or of the one of evaluate_at.
bool loads_state(const Program& program) {
  return std::ranges::any_of(program.inputs, is_state, &Channel::name) ||
         std::ranges::any_of(program.parameters, is_state, &ParameterSlot::name);
}

/// Adds the slots that facts are of, where they are not there.
void add_slots(Program& program, const std::vector<Fact>& facts, const Program& from) {
  for (const ParameterSlot& slot : from.parameters) {
    Program one;
    one.parameters.push_back(slot);
    const bool is_wanted = !facts_of(facts, one).empty();
    const auto is_there = std::ranges::find(program.parameters, slot.name, &ParameterSlot::name);
    if (is_wanted && is_there == program.parameters.end()) program.parameters.push_back(slot);
  }
}

/// The least float and the greatest that are needed to hold it; from -0 on where that may be.
Fact implied(const std::string& channel, const Range& range) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  auto low = static_cast<float>(range.low), high = static_cast<float>(range.high);
  if (double(low) > range.low) low = std::nextafter(low, -infinity);
  if (double(high) < range.high) high = std::nextafter(high, infinity);
  if (low == 0.0f && range.minus_zero) low = -0.0f;
  return {.name = channel, .low = low, .high = high, .is_implied = true};
}

}  // namespace

std::vector<Fact> state_facts(std::vector<Program>& programs, const CompileOptions& options) {
  const auto begin = std::ranges::find(programs, "begin", &Program::name);
  if (begin == programs.end() || options.backend == Backend::reference) return {};
  CompileOptions of_parameters = options;
  of_parameters.facts = facts_of_parameters(options.facts, *begin);
  if (of_parameters.facts.empty()) return {};
  const Program lowered = lower(*begin, of_parameters);
  if (is_too_large(lowered, options) || options.stop.is_due()) return {};
  const std::vector<Range> ranges =
      output_ranges(lowered, known_by(of_parameters.facts, lowered, options.accuracy));
  std::vector<Fact> facts;
  for (std::size_t i = 0; i < lowered.outputs.size(); ++i) {
    const Channel& channel = lowered.outputs[i];
    if (!is_state(channel.name) || channel.type != Scalar::f32) continue;
    if (ranges[i].is_bounded()) facts.push_back(implied(channel.name, ranges[i]));
  }
  for (Program& program : programs) {
    if (loads_state(program)) add_slots(program, of_parameters.facts, *begin);
  }
  return facts;
}

}  // namespace nacre
