#pragma once

#include "runtime/program/program.h"

namespace nacre {

/// Computes what only regions need in these: where no lane enters them it is not computed at all.
/// What several need is computed in each of them where whether they are entered is one thing for
/// all lanes, as of two ways of which a parameter says which is taken. Comes last, on a Program
/// whose varying values are marked: changes no bit.
Program sink(const Program& program);

}  // namespace nacre
