#include "runtime/process_end.h"

#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>

namespace nacre {

namespace {

/// Of this process: its number in the upper half, whether it is ending, how many are at work.
/// Another process's state is one of nobody at work. The end of a process is a matter of the
/// process, so this is too; without a destructor it is there until the last thread is gone.
constinit std::atomic<std::uint64_t> state = 0;
constexpr std::uint64_t is_ending = std::uint64_t{1} << 31;
constexpr std::uint64_t at_work = is_ending - 1;

/// Of those at work, the calling thread's.
constinit thread_local std::uint64_t own_work = 0;

std::uint64_t of_this_process(std::uint64_t known) {
  const auto process = static_cast<std::uint64_t>(getpid());
  return known >> 32 == process ? known : process << 32;
}

void end() {
  std::uint64_t known = state.load();
  while (!state.compare_exchange_weak(known, of_this_process(known) | is_ending)) {
  }
  known = state.load();
  while ((known & at_work) > own_work) {
    state.wait(known);
    known = state.load();
  }
}

}  // namespace

AtWork::AtWork() {
  std::uint64_t known = state.load();
  do {
    may_work_ = (of_this_process(known) & is_ending) == 0;
    if (!may_work_) return;
  } while (!state.compare_exchange_weak(known, of_this_process(known) + 1));
  ++own_work;
}

AtWork::~AtWork() {
  if (!may_work_) return;
  --own_work;
  --state;
  state.notify_all();
}

void wait_for_work_at_exit() {
  // Without room for another, the process ends as it would have without.
  (void)std::atexit(end);
}

}  // namespace nacre
