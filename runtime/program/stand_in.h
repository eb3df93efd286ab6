#pragma once

#include <cstddef>

#include "runtime/program/program.h"

namespace nacre {

/// `program` without Op::stand_in: of each only operand 0, what stands in, or only operand 1, what
/// it stands in for, as those need who must not see noise; channels that nothing reads any more are
/// no inputs. As it was where there is none. What is varying is marked. Ends early as `transform`
/// does, with more than `most` instructions.
Program with_stand_ins(const Program& program, std::size_t operand,
                       std::size_t most = std::size_t{1} << 31);

}  // namespace nacre
