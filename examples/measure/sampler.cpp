#include "examples/measure/sampler.h"

#include <signal.h>
#include <sys/syscall.h>
#include <time.h>
#include <ucontext.h>
#include <unistd.h>

namespace nacre::measure {

namespace {

struct Samples {
  explicit Samples(std::size_t most) : addresses(most) {}
  std::vector<std::uintptr_t> addresses;
  std::atomic<std::size_t> count = 0;
};

void take_sample(int /*signal*/, siginfo_t* info, void* context) {
  auto& samples = *static_cast<Samples*>(info->si_value.sival_ptr);
  const std::size_t i = samples.count;
  if (i == samples.addresses.size()) return;
  const auto& registers = static_cast<const ucontext_t*>(context)->uc_mcontext.gregs;
  samples.addresses[i] = static_cast<std::uintptr_t>(registers[REG_RIP]);
  samples.count = i + 1;
}

/// SIGPROF to the thread that made it. Of real time: timers of processor time tick with the
/// system's clock, 100 to 250 times a second.
class Timer {
 public:
  Timer(Samples& samples, int frequency) {
    struct sigaction action{};
    action.sa_sigaction = take_sample;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaction(SIGPROF, &action, &before_);
    sigevent event{};
    event.sigev_notify = SIGEV_THREAD_ID;
    event.sigev_signo = SIGPROF;
    event.sigev_value.sival_ptr = &samples;
    event._sigev_un._tid = static_cast<pid_t>(syscall(SYS_gettid));
    is_running_ = timer_create(CLOCK_MONOTONIC, &event, &timer_) == 0;
    const timespec period{.tv_sec = 0, .tv_nsec = 1'000'000'000L / frequency};
    const itimerspec times{.it_interval = period, .it_value = period};
    if (is_running_) timer_settime(timer_, 0, &times, nullptr);
  }
  /// A signal that is on its way is ignored, not deadly.
  ~Timer() {
    if (is_running_) timer_delete(timer_);
    if (before_.sa_handler == SIG_DFL) before_.sa_handler = SIG_IGN;
    sigaction(SIGPROF, &before_, nullptr);
  }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

 private:
  timer_t timer_{};
  bool is_running_ = false;
  struct sigaction before_{};
};

}  // namespace

std::vector<std::uintptr_t> sample(const std::function<void()>& work, int frequency,
                                   std::size_t most) {
  Samples samples(most);
  {
    const Timer timer(samples, frequency);
    work();
  }
  samples.addresses.resize(samples.count);
  return std::move(samples.addresses);
}

}  // namespace nacre::measure
