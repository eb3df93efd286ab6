#include "jit/record/leaves.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include "jit/record/pattern.h"

namespace nacre {

namespace {

/// The bits of component i of a literal.
std::uint32_t component_bits(const Value& value, std::size_t i) {
  if (value.type == Type::integer || value.type == Type::boolean) {
    return i < value.ints.size() ? static_cast<std::uint32_t>(value.ints[i]) : 0u;
  }
  return i < value.floats.size() ? std::bit_cast<std::uint32_t>(value.floats[i]) : 0u;
}

}  // namespace

Recorded literal(const Source& source, Type type, const RecordOptions& options) {
  Recorded value;
  value.type = type;
  if (is_text(type)) {
    if (!source.value.texts.empty()) value.text = source.value.texts.front();
    if (type == Type::filename && !value.text.empty() && options.resolve_file) {
      value.text = options.resolve_file(value.text, source.document);
    }
    return value;
  }
  const Scalar scalar = scalar_of(type);
  for (int i = 0; i < component_count(type); ++i) {
    std::uint32_t bits = component_bits(source.value, static_cast<std::size_t>(i));
    if (scalar == Scalar::b1) bits = bits != 0;
    value.parts.push_back({nullptr, bits, scalar});
  }
  return value;
}

Recorded parameter(const Parameter& parameter, const RecordOptions& options, Recorder& recorder) {
  const Type type = parameter.type;
  if (!is_live(parameter, options)) {
    Source frozen;
    frozen.kind = Source::Kind::literal;
    frozen.value = parameter.value;
    return literal(frozen, type, options);
  }
  Recorded value;
  value.type = type;
  const int count = component_count(type);
  for (int i = 0; i < count; ++i) {
    value.parts.push_back(
        recorder.parameter(slot_name(parameter.path, i, count), scalar_of(type),
                           component_bits(parameter.value, static_cast<std::size_t>(i))));
  }
  return value;
}

bool is_live(const Parameter& parameter, const RecordOptions& options) {
  if (is_text(parameter.type)) return false;
  if (options.parameters == ParameterMode::live && !parameter.is_default) return true;
  return fits_any(parameter.path, options.live);
}

std::string slot_name(const std::string& parameter, int i, int count) {
  if (count == 1) return parameter;
  if (count <= 4) return parameter + '.' + "xyzw"[i];
  return parameter + '.' + std::to_string(i);
}

}  // namespace nacre
