#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {

/// The tool as a process of its own that can be sent signals.
class Process {
 public:
  Process(const std::vector<std::string>& arguments, const std::string& errors) {
    std::vector<std::string> words{NACRE_TOOL};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    id_ = ::fork();
    if (id_ != 0) return;
    // A shell that runs us in the background has SIGINT ignored.
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
    ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
    ::dup2(::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  void send(int signal) const { ::kill(id_, signal); }
  /// True once the tool has its handlers, so that a signal is not the loader's.
  bool handles(int signal) const {
    const std::string status = text_of("/proc/" + std::to_string(id_) + "/status");
    const std::size_t at = status.find("SigCgt:");
    if (at == std::string::npos) return false;
    const auto caught = std::strtoull(status.c_str() + at + 7, nullptr, 16);
    return ((caught >> (signal - 1)) & 1) != 0;
  }
  /// As waitpid gives it.
  int wait() const {
    int status = 0;
    ::waitpid(id_, &status, 0);
    return status;
  }

 private:
  pid_t id_;
};

}  // namespace nacre
