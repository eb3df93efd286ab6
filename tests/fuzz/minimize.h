#pragma once

#include <functional>
#include <string>

#include "tests/fuzz/tree.h"

namespace nacre::fuzz {

/// How a process ended that ran a text: "" well, else "signal 11", "exit 1", "time".
std::string ending(const std::function<void()>& run);

/// The smallest document found, by leaving out elements and attributes, for which
/// `fails_alike` still holds. It holds for `tree`.
Tree minimize(Tree tree, const std::function<bool(const Tree&)>& fails_alike);

}  // namespace nacre::fuzz
