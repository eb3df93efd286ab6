#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "runtime/program/program.h"
#include "runtime/program/recorder.h"

namespace nacre {

/// Says what stands in for one instruction: a value recorded on `recorder`, or
/// nothing to record the instruction itself again. `operands` are the
/// instruction's, in the new recording. Not asked about structure, calls,
/// stores, constants and arguments.
using Replacement = std::function<std::optional<Ref>(
    Recorder& recorder, const Instruction& instruction, std::span<const Ref> operands)>;

/// Whether the if_any region that instruction `open` of a function opens is to be
/// flattened: its body is recorded for all lanes, and its merges become selects.
using Flattening = std::function<bool(const Function& function, std::size_t open)>;

/// Records something more, after everything else.
using Finish = std::function<void(Recorder& recorder)>;

/// Records a Program again, instruction by instruction, with some replaced.
/// Folding, simplification and sharing happen on the way; what becomes unused
/// is removed. What is varying is not marked: see mark_varying(). Channels, slots and textures
/// stay as they are, so what is bound to one Program fits the other. This is the frame of most
/// passes. Ends early, with as many instructions and one that no engine is to run, once there are
/// more than `most`. `flattens` and `finish` may be empty. `keeps_sign`: see
/// Recorder::keep_sign_of_zero(). A region that is entered for no lane, as is then known, is left
/// out; one that is entered for all stands without its mask.
Program transform(const Program& program, const Replacement& replace,
                  std::size_t most = std::size_t{1} << 31, const Flattening& flattens = {},
                  const Finish& finish = {}, bool keeps_sign = false);

/// What a pass gives that would make more than `most` instructions: so many and one more,
/// which mean nothing.
Program too_large(std::size_t most);

}  // namespace nacre
