#include "examples/tool/stop.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <stop_token>
#include <string_view>
#include <system_error>
#include <thread>

#include "examples/common/partial_file.h"
#include "examples/tool/report.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

namespace {

/// A process has one set of signals, so this has one state. Never destroyed: the thread
/// that ends the process may be any.
struct State {
  std::stop_source source;
  std::atomic<int> signal = 0;
  std::mutex mutex;
  std::vector<std::string> promised;
  std::vector<std::string> missing;
  std::vector<std::string> partial;  ///< Files that are not whole, and what they are.
  /// How long a stop that was asked for may take before the process just ends.
  std::atomic<int> patience = 300;  // ms

  int reading = -1, writing = -1;  ///< Ends of a pipe: a byte for each signal, 0 for the end.
  std::jthread watcher;
};

State& state() {
  static State* const only = new State;
  return *only;
}

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

/// May do next to nothing: what is to be done about a signal the watcher does.
void handle(int signal) {
  const int error = errno;
  const auto byte = static_cast<char>(signal);
  (void)!::write(state().writing, &byte, 1);
  errno = error;
}

/// Those that whoever started us has ignored, as nohup does, stay so.
bool is_ignored(int signal) {
  struct sigaction action{};
  return sigaction(signal, nullptr, &action) == 0 && (action.sa_flags & SA_SIGINFO) == 0 &&
         action.sa_handler == SIG_IGN;
}

void set_action(void (*handler)(int)) {
  struct sigaction action{};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  for (const int signal : signals) {
    if (!is_ignored(signal)) sigaction(signal, &action, nullptr);
  }
}

void watch() {
  State& all = state();
  pollfd pipe{all.reading, POLLIN, 0};
  int wait = -1;
  while (true) {
    const int events = ::poll(&pipe, 1, wait);
    if (events < 0) continue;  // EINTR
    char signal = 0;
    if (events == 0 || ::read(all.reading, &signal, 1) != 1) end_stopped();
    if (signal == 0) return;
    if (all.signal != 0) end_stopped();
    all.signal = signal;
    all.source.request_stop();
    wait = all.patience;
  }
}

const char* name_of(int signal) {
  switch (signal) {
    case SIGINT: return "SIGINT";
    case SIGTERM: return "SIGTERM";
    case SIGHUP: return "SIGHUP";
    default: return "a signal";
  }
}

Diagnostic complaint(int signal, const std::vector<std::string>& missing,
                     const std::vector<std::string>& partial, std::size_t promised) {
  Diagnostic said;
  said.code = "stopped";
  said.message = fmt::format("stopped by {}", name_of(signal));
  for (const std::string& each : partial) said.message += "; " + printable(each);
  if (!missing.empty()) {
    std::string& text = said.expected;
    text = fmt::format("{} file{}, not written: ", promised, promised == 1 ? "" : "s");
    constexpr std::size_t most = 4;
    for (std::size_t i = 0; i < std::min(most, missing.size()); ++i) {
      text += (i == 0 ? "" : ", ") + printable(missing[i]);
    }
    if (missing.size() > most) text += fmt::format(" and {} more", missing.size() - most);
  }
  return said;
}

}  // namespace

StopOnSignal::StopOnSignal() {
  State& all = state();
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return;  // Then signals end the process as any other.
  all.reading = ends[0];
  all.writing = ends[1];
  try {
    all.watcher = std::jthread(watch);
    set_action(handle);
  } catch (const std::system_error&) {  // No thread to be had: as above.
  }
}

StopOnSignal::~StopOnSignal() {
  State& all = state();
  if (!all.watcher.joinable()) return;
  set_action(SIG_DFL);
  const char end = 0;
  if (::write(all.writing, &end, 1) == 1) all.watcher.join();
}

Stop stop() { return Stop(state().source.get_token()); }

void promise_files(const std::vector<std::string>& files) {
  State& all = state();
  const std::scoped_lock lock(all.mutex);
  for (const std::string& file : files) {
    // What nobody asked for has no name; what is promised twice is one file.
    if (file.empty() || std::ranges::find(all.promised, file) != all.promised.end()) continue;
    all.promised.push_back(file);
    all.missing.push_back(file);
  }
}

void withdraw_promise(const std::string& file) {
  State& all = state();
  const std::scoped_lock lock(all.mutex);
  std::erase(all.promised, file);
  std::erase(all.missing, file);
}

void keep_promise(const std::string& file) {
  State& all = state();
  const std::scoped_lock lock(all.mutex);
  std::erase(all.missing, file);
}

void keep_promise_partly(const std::string& file, const std::string& what) {
  keep_promise(file);
  State& all = state();
  const std::scoped_lock lock(all.mutex);
  all.partial.push_back(file + " has " + what);
}

void take_time_to_stop(double seconds) { state().patience = static_cast<int>(1000 * seconds); }

bool is_stopped_early() {
  State& all = state();
  const std::scoped_lock lock(all.mutex);
  return all.signal != 0 && (!all.missing.empty() || !all.partial.empty());
}

void end_stopped() {
  State& all = state();
  static std::mutex once;
  once.lock();  // And stays locked: the first to come ends it for all.
  host::abandon_partial_files();
  std::string text;
  {
    const std::scoped_lock lock(all.mutex);
    text = said_line(complaint(all.signal, all.missing, all.partial, all.promised.size()));
  }
  if (::isatty(STDERR_FILENO) != 0 && !report_form().json)
    text.insert(0, "\r\033[K");  // Over the progress.
  // Not through stdio: a thread that waits for a full pipe has its lock.
  (void)!::write(STDERR_FILENO, text.data(), text.size());
  const int signal = all.signal;
  struct sigaction action{};
  action.sa_handler = SIG_DFL;
  sigaction(signal, &action, nullptr);
  ::kill(::getpid(), signal);
  std::_Exit(128 + signal);  // Where that is blocked.
}

}  // namespace nacre::tool
