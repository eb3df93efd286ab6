// Values, operations, leaves and regions, for hosts that write nodes.
#include <bit>

#include "jit/api/call.h"
#include "jit/api/recording.h"
#include "runtime/program/fold.h"

using namespace nacre;
using namespace nacre::api;

namespace {

nacre_value zero(int type) { return {nullptr, 0, type}; }

/// Runs `body` on the recording that the handle is of; `otherwise` where the host is in none.
template <class Body>
auto with(nacre_recorder* recorder, Body&& body, decltype(body(*Recording::current())) otherwise) {
  Recording* const recording = Recording::current();
  if (recording == nullptr || recorder != recording->handle()) return otherwise;
  return body(*recording);
}
template <class Body>
void with(nacre_recorder* recorder, Body&& body) {
  Recording* const recording = Recording::current();
  if (recording != nullptr && recorder == recording->handle()) body(*recording);
}

}  // namespace

nacre_value nacre_literal_float(float value) {
  return {nullptr, flush_denormal(std::bit_cast<std::uint32_t>(value)), NACRE_FLOAT};
}

nacre_value nacre_literal_int(int32_t value) {
  return {nullptr, static_cast<std::uint32_t>(value), NACRE_INT};
}

nacre_value nacre_literal_bool(int value) { return {nullptr, value != 0 ? 1u : 0u, NACRE_BOOL}; }

nacre_value nacre_record(nacre_operation operation, const nacre_value* operands, size_t count,
                         uint32_t immediate) {
  Recording* const recording = Recording::current();
  // Outside of a body there is nothing to record into, and nobody to tell.
  if (recording == nullptr || (operands == nullptr && count != 0)) return zero(NACRE_FLOAT);
  return recording->record(operation, operands, count, immediate);
}

nacre_value nacre_read_channel(nacre_recorder* recorder, const char* name, int type) {
  return with(
      recorder,
      [&](Recording& recording) {
        return recording.give(recording.read_channel(text_or_empty(name), scalar_of_number(type)));
      },
      zero(type));
}

nacre_value nacre_read_slot(nacre_recorder* recorder, const char* name, nacre_value literal) {
  return with(
      recorder,
      [&](Recording& recording) {
        return recording.give(recording.read_slot(text_or_empty(name), literal));
      },
      zero(literal.type));
}

uint32_t nacre_table(nacre_recorder* recorder, const char* name, const float* values,
                     size_t count) {
  return with(
      recorder,
      [&](Recording& recording) {
        if (values == nullptr || count == 0) {
          recording.fail("a table needs an entry");
          return UINT32_MAX;
        }
        return recording.recorder().table(text_or_empty(name), {values, count});
      },
      UINT32_MAX);
}

nacre_value nacre_keep(nacre_recorder* recorder, nacre_value value) {
  return with(
      recorder, [&](Recording& recording) { return recording.keep(value); }, zero(value.type));
}

void nacre_begin_if(nacre_recorder* recorder, nacre_value mask) {
  with(recorder, [&](Recording& recording) { recording.begin_if(mask); });
}

nacre_value nacre_merge(nacre_recorder* recorder, nacre_value inside, nacre_value outside) {
  return with(
      recorder, [&](Recording& recording) { return recording.merge(inside, outside); },
      zero(inside.type));
}

void nacre_end_if(nacre_recorder* recorder) {
  with(recorder, [](Recording& recording) { recording.end_if(); });
}

void nacre_begin_loop(nacre_recorder* recorder, nacre_value mask, uint32_t bound) {
  with(recorder, [&](Recording& recording) { recording.begin_loop(mask, bound); });
}

nacre_value nacre_carry(nacre_recorder* recorder, nacre_value initial) {
  return with(
      recorder, [&](Recording& recording) { return recording.carry(initial); }, zero(initial.type));
}

nacre_value nacre_next(nacre_recorder* recorder, nacre_value carry, nacre_value value) {
  return with(
      recorder, [&](Recording& recording) { return recording.next(carry, value); },
      zero(carry.type));
}

void nacre_again(nacre_recorder* recorder, nacre_value goes_on) {
  with(recorder, [&](Recording& recording) { recording.again(goes_on); });
}

void nacre_end_loop(nacre_recorder* recorder) {
  with(recorder, [](Recording& recording) { recording.end_loop(); });
}
