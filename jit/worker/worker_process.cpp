#include "jit/worker/worker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

// The header of glibc 2.36 does not say itself that it is C.
extern "C" {
#include <sys/pidfd.h>
}

#include "jit/worker/message.h"
#include "jit/worker/socket.h"

extern char** environ;

namespace nacre {

namespace {

/// What a new process has: the socket, nothing else of ours, and nowhere to print.
class SpawnActions {
 public:
  explicit SpawnActions(int socket) {
    posix_spawn_file_actions_init(&actions_);
    // First, for the others might be where this goes.
    posix_spawn_file_actions_adddup2(&actions_, socket, worker_socket);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", O_WRONLY, 0);
    }
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// Signals as a new program expects them, whatever the host has blocked or ignored; a group
/// of its own, so that Ctrl-C goes to the host alone.
class SpawnAttributes {
 public:
  SpawnAttributes() {
    posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;

  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

}  // namespace

std::unique_ptr<WorkerProcess> WorkerProcess::start(const std::filesystem::path& program,
                                                    const WorkerLimits& limits,
                                                    std::string& fault) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    fault = std::strerror(errno);
    return nullptr;
  }
  const std::string path = program.string();
  const std::string megabytes = std::to_string(limits.megabytes);
  char* const arguments[] = {const_cast<char*>(path.c_str()), const_cast<char*>(megabytes.c_str()),
                             nullptr};
  // dup2() onto itself would leave the descriptor to be closed.
  int theirs = ends[1];
  if (theirs == worker_socket) theirs = ::fcntl(theirs, F_DUPFD_CLOEXEC, worker_socket + 1);
  pid_t process = 0;
  const int failed = ::posix_spawn(&process, path.c_str(), SpawnActions(theirs).get(),
                                   SpawnAttributes().get(), arguments, environ);
  ::close(ends[1]);
  if (theirs != ends[1]) ::close(theirs);
  if (failed != 0) {
    ::close(ends[0]);
    fault = fmt::format("'{}': {}", path, std::strerror(failed));
    return nullptr;
  }
  return std::unique_ptr<WorkerProcess>(new WorkerProcess(process, ends[0]));
}

WorkerProcess::WorkerProcess(pid_t process, int socket)
    : process_(process), handle_(::pidfd_open(process, 0)), socket_(socket) {}

WorkerProcess::~WorkerProcess() {
  ::close(socket_);
  if (process_ != 0) end();
  if (handle_ >= 0) ::close(handle_);
}

/// A host that waits for any child may have taken its end, and the number be another's.
void WorkerProcess::end() {
  if (handle_ >= 0) {
    (void)::pidfd_send_signal(handle_, SIGKILL, nullptr, 0);
  } else {
    ::kill(process_, SIGKILL);
  }
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<std::string> WorkerProcess::ask(const std::string& request,
                                              const std::function<bool()>& gives_up) const {
  if (!send_frame(socket_, request, gives_up)) return std::nullopt;
  return receive_frame(socket_, gives_up);
}

std::string WorkerProcess::how_it_ended() {
  int status = 0;
  pid_t ended = 0;
  // It may still be about to end: its socket closes first.
  for (int i = 0; i < 100 && ended == 0; ++i) {
    ended = ::waitpid(process_, &status, WNOHANG);
    if (ended == 0) ::usleep(10'000);
  }
  if (ended != process_) return "it does not answer";
  process_ = 0;
  if (WIFSIGNALED(status)) return fmt::format("it crashed ({})", ::strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == worker_out_of_memory) return "it ran out of memory";
  return fmt::format("it ended with status {}", WEXITSTATUS(status));
}

}  // namespace nacre
