#include "tests/fuzz/workers.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <thread>
#include <vector>

#include "tests/support/sanitizer.h"

namespace nacre::fuzz {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double share = address_sanitizer ? 5 : 1;
constexpr std::uint64_t batch = 1000;  // Pieces of one process.
constexpr std::uint64_t none = ~std::uint64_t{0};

/// What a process says about itself while it works.
struct Progress {
  std::atomic<std::uint64_t> current{none};  ///< The piece at work; none while preparing.
  std::atomic<std::uint64_t> read{0};
  std::atomic<std::uint64_t> clean{0};
  std::atomic<std::uint64_t> ran{0};
};

/// Makes the system end this process when it has computed that much longer.
void allow(double cpu_seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(cpu_seconds);
  timer.it_value.tv_usec =
      static_cast<suseconds_t>((cpu_seconds - static_cast<double>(timer.it_value.tv_sec)) * 1e6);
  setitimer(ITIMER_PROF, &timer, nullptr);
}

[[noreturn]] void be_worker(const Work& work, Progress& progress, const std::string& log,
                            std::uint64_t begin, std::uint64_t end) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, 2);
  work.prepare();
  const auto stride = static_cast<std::uint64_t>(work.jobs);
  for (std::uint64_t piece = begin; piece < end; piece += stride) {
    progress.current = piece;
    allow(work.budget.cpu_seconds);
    const Result result = work.run(piece);
    allow(0);
    progress.read += result.read;
    progress.clean += result.clean;
    progress.ran += result.ran;
  }
  progress.current = end;
  _exit(0);  // The host's threads and caches are not what is tested.
}

double resident_megabytes(pid_t process) {
  std::ifstream stream("/proc/" + std::to_string(process) + "/statm");
  double size = 0, resident = 0;
  stream >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// One of the processes, and what it does.
class Worker {
 public:
  Worker(const Work& work, int number)
      : work_(work),
        log_((work.keep / ("worker" + std::to_string(number) + ".log")).string()),
        next_(work.first + static_cast<std::uint64_t>(number)) {
    void* shared =
        mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) std::abort();
    progress_ = new (shared) Progress;
  }

  /// False when there is nothing left to do.
  bool step() {
    if (process_ == 0) return start();
    int status = 0;
    if (waitpid(process_, &status, WNOHANG) == process_) {
      ended(status);
      return true;
    }
    watch();
    return true;
  }

  std::uint64_t failed() const { return failed_; }
  Result sum() const { return {progress_->read, progress_->clean, progress_->ran}; }

 private:
  bool start() {
    const std::uint64_t end = work_.first + work_.count;
    if (next_ >= end) return false;
    last_ = std::min(end, next_ + batch * static_cast<std::uint64_t>(work_.jobs));
    progress_->current = none;
    seen_ = none;
    seen_at_ = Clock::now();
    reason_.clear();
    std::fflush(nullptr);
    process_ = fork();
    if (process_ == 0) be_worker(work_, *progress_, log_, next_, last_);
    return true;
  }

  void watch() {
    const std::uint64_t current = progress_->current;
    if (current != seen_) {
      seen_ = current;
      seen_at_ = Clock::now();
    }
    const std::chrono::duration<double> waited = Clock::now() - seen_at_;
    if (resident_megabytes(process_) > work_.budget.megabytes) end("memory");
    if (current != none && waited.count() > work_.budget.wall_seconds) end("waits");
  }

  void end(const char* reason) {
    reason_ = reason;
    kill(process_, SIGKILL);
  }

  void ended(int status) {
    process_ = 0;
    const std::uint64_t current = progress_->current;
    const auto stride = static_cast<std::uint64_t>(work_.jobs);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && current == last_) {
      while (next_ < last_) next_ += stride;
      return;
    }
    ++failed_;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF) reason_ = "time";
    if (reason_.empty()) {
      reason_ = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                    : "exit " + std::to_string(WEXITSTATUS(status));
    }
    if (current == none) {
      std::printf("preparing failed: %s\n", reason_.c_str());
      next_ = none;
      return;
    }
    keep(current);
    next_ = current + stride;
  }

  void keep(std::uint64_t piece) const {
    const std::string name = (work_.keep / std::to_string(piece)).string();
    std::ofstream(name + ".mtlx", std::ios::binary) << work_.text(piece);
    std::error_code ignored;
    std::filesystem::rename(log_, name + ".log", ignored);
    std::printf("%s.mtlx: %s\n", name.c_str(), reason_.c_str());
    std::fflush(stdout);
  }

  const Work& work_;
  std::string log_;
  Progress* progress_ = nullptr;
  pid_t process_ = 0;
  std::uint64_t next_;
  std::uint64_t last_ = 0;
  std::uint64_t seen_ = none;
  Clock::time_point seen_at_;
  std::string reason_;
  std::uint64_t failed_ = 0;
};

}  // namespace

Budget default_budget() { return {5 * share, 60 * share, 1024 * (share > 1 ? 3 : 1)}; }

Totals run_work(const Work& work) {
  std::filesystem::create_directories(work.keep);
  std::vector<Worker> workers;
  workers.reserve(static_cast<std::size_t>(work.jobs));
  for (int i = 0; i < work.jobs; ++i) workers.emplace_back(work, i);
  for (bool busy = true; busy;) {
    busy = false;
    for (Worker& worker : workers) busy = worker.step() || busy;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  Totals totals;
  for (const Worker& worker : workers) {
    totals.failed += worker.failed();
    const Result sum = worker.sum();
    totals.sum.read += sum.read;
    totals.sum.clean += sum.clean;
    totals.sum.ran += sum.ran;
  }
  return totals;
}

}  // namespace nacre::fuzz
