#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace nacre::measure {

/// Runs `work` on this thread and looks, `frequency` times a second, which machine
/// instruction is next: their addresses, at most `most`. Takes SIGPROF for that time. Empty
/// where the system has no such timer.
std::vector<std::uintptr_t> sample(const std::function<void()>& work, int frequency = 4000,
                                   std::size_t most = 1 << 16);

}  // namespace nacre::measure
