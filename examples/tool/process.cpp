#include "examples/tool/process.h"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <system_error>
#include <utility>

#include "examples/common/partial_file.h"
#include "examples/tool/options.h"
#include "examples/tool/report.h"
#include "examples/tool/stop.h"

namespace nacre::tool {

namespace {

Diagnostic failure(const std::exception& thrown) {
  Diagnostic said;
  if (dynamic_cast<const std::bad_alloc*>(&thrown) != nullptr) {
    said.code = "out-of-memory";
    said.message = "this needs more memory than there is";
  } else {
    said.code = "system";
    said.message = "the system refuses";
    said.found = thrown.what();
  }
  return said;
}

/// errno of what failed first on standard output, of which a process has one.
int output_error = 0;

void say(const char* text) {
  const std::size_t size = std::strlen(text);
  (void)!::write(STDERR_FILENO, text, size);
}

/// Leaves no partial file behind, as far as there is memory to find them.
[[noreturn]] void end_with_problems() {
  try {
    host::abandon_partial_files();
  } catch (...) {
  }
  std::_Exit(status_problems);
}

/// For what a thread throws that is not ours, TBB's or OpenImageIO's, or a function throws
/// that must not. Whatever is a fault of our own aborts as it always does.
void terminated() {
  // What is done here may run out of memory too.
  thread_local bool is_ending_here = false;
  if (std::exchange(is_ending_here, true)) std::_Exit(status_problems);
  // Another thread that has come here ends the process once it has said why.
  static std::atomic_flag is_ending = ATOMIC_FLAG_INIT;
  while (is_ending.test_and_set()) ::pause();
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    say(report_form().json
            ? R"({"severity":"error","code":"out-of-memory","message":"this needs more memory than )"
              R"(there is","text":"error: this needs more memory than there is [out-of-memory]"})"
              "\n"
            : "error: this needs more memory than there is [out-of-memory]\n");
    end_with_problems();
  } catch (const std::system_error& error) {
    say(said_line(failure(error)).c_str());
    end_with_problems();
  } catch (...) {
  }
  std::abort();
}

/// Before anything else, because libraries that we load make threads while they are
/// loaded, and throw where there are none.
void prepare_terminate(int /*argc*/, char** /*argv*/, char** /*environment*/) {
  std::set_terminate(terminated);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const first)(int, char**,
                                                                  char**) = prepare_terminate;

}  // namespace

void prepare_process() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // Open for the wrong direction: every use fails as one of a closed stream does. The
    // lowest free number is taken, which is this one.
    (void)!::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void keep_freed_memory() {
  constexpr int kept = 64 << 20;
  mallopt(M_TRIM_THRESHOLD, kept);
  mallopt(M_MMAP_THRESHOLD, kept / 2);
  mallopt(M_TOP_PAD, 4 << 20);
}

int guarded(const std::string& file, const std::function<int()>& run) {
  Diagnostic said;
  try {
    return run();
  } catch (const std::bad_alloc& thrown) {
    said = failure(thrown);
  } catch (const std::system_error& thrown) {
    if (std::ferror(stdout) != 0) {  // fmt's; finish_output says it.
      output_error = thrown.code().value();
      return status_problems;
    }
    said = failure(thrown);
  }
  said.where.file = file;
  std::fputs(said_line(said).c_str(), stderr);
  return status_problems;
}

void file_is_written(const std::string& file, bool quiet) {
  keep_promise(file);
  if (quiet) return;
  // At once, for whoever waits for it; failing is remembered for the end.
  const bool printed = std::fprintf(stdout, "%s\n", file.c_str()) >= 0;
  if (!printed || std::fflush(stdout) != 0) output_error = errno;
}

int finish_output(int status) {
  if (std::fflush(stdout) != 0) output_error = errno;
  std::cout.flush();  // CLI11's, after it: it empties the same buffer and keeps no reason.
  if (output_error == 0 && std::ferror(stdout) == 0 && std::cout) return status;
  const int reason = output_error;
  Diagnostic said;
  said.code = "cannot-write";
  said.message = "standard output could not be written";
  if (reason != 0) said.found = std::strerror(reason);
  std::fputs(said_line(said).c_str(), stderr);
  return status == status_ok ? status_problems : status;
}

}  // namespace nacre::tool
