#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "jit/worker/compiler.h"

namespace nacre {

/// One running nacre-compile-worker. Ended when it is destroyed.
class WorkerProcess {
 public:
  /// Null, with the reason, if it cannot be started.
  static std::unique_ptr<WorkerProcess> start(const std::filesystem::path& program,
                                              const WorkerLimits& limits, std::string& fault);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// Sends a request and waits for its answer, the frames of message.h. Nothing if it ended,
  /// or `gives_up` said so; after that it is of no more use.
  std::optional<std::string> ask(const std::string& request,
                                 const std::function<bool()>& gives_up) const;
  /// In a child of fork(): the process is the parent's.
  void forget() { process_ = 0; }
  /// Waits for a process that does not answer any more: "it crashed (Segmentation fault)".
  std::string how_it_ended();

 private:
  WorkerProcess(pid_t process, int socket);
  void end();

  pid_t process_;  ///< 0 once it is known to have ended.
  int handle_;     ///< Of the process, which its number may outlive; -1 where there are none.
  int socket_;
};

}  // namespace nacre
