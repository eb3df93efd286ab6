#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/program/program.h"
#include "runtime/program/recorder.h"
#include "runtime/value/ref.h"

namespace nacre {

/// A named result of an entry point.
struct SliceOutput {
  std::string name;  ///< Of the channel: "f.x".
  Ref value;         ///< Recorded at top level of the entry, or a literal.
};

/// What `slice` does with keep marks (Recorder::keep).
enum class Keeps {
  pass,  ///< A keep is its operand: one kernel computes everything.
  load,  ///< A keep is the input channel "state.<k>".
};

/// The part of a recording that computes `outputs`, as a Program of its own:
/// other operations, functions, channels, slots, tables and textures are left
/// out, and varying is marked. The recording is not changed, so one recording
/// serves as many entry points as wanted.
Program slice(const Program& recorded, std::string name, std::span<const SliceOutput> outputs,
              Keeps keeps = Keeps::pass);

/// Removes what no store needs, in place; `slice` has done it already. With
/// `keeps_interface` the channels and slots stay, needed or not.
void remove_dead(Program& program, bool keeps_interface = false);

/// For each k the value that keep k marks, as output "state.<k>": what `begin` stores.
std::vector<SliceOutput> state_outputs(Recorder& recorder, std::span<const std::uint32_t> keeps);

/// The numbers k of the channels "state.<k>" that a Program reads.
std::vector<std::uint32_t> state_channels(const Program& program);

}  // namespace nacre
