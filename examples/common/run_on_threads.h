#pragma once

#include <functional>

namespace nacre::host {

/// `wanted`, or for 0 as many as the machine has cores.
int thread_count(int wanted);

/// Runs `work` on so many threads at once, this one among them (0: one a core), and returns
/// when all have ended. Where there are no more threads to be had those there are do it all.
/// The first exception that leaves `work` is thrown again, here: of memory too, of which
/// none is needed for that.
void run_on_threads(int threads, const std::function<void()>& work);

}  // namespace nacre::host
