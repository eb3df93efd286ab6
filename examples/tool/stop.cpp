#include "examples/tool/stop.h"

#include <pthread.h>

#include <csignal>
#include <stop_token>
#include <thread>

namespace nacre::tool {

namespace {

// A program has one set of signal handlers, so this has one state. The handler
// itself only writes a flag: what it may do is little.
volatile std::sig_atomic_t requested = 0;
std::stop_source source;
std::jthread watcher;

void handle(int signal) {
  requested = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

StopOnSignal::StopOnSignal() {
  requested = 0;
  source = std::stop_source();
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
  watcher = std::jthread([](const std::stop_token& ended) {
    while (!ended.stop_requested()) {
      if (requested != 0) source.request_stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
}

StopOnSignal::~StopOnSignal() {
  watcher = std::jthread();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

std::stop_token StopOnSignal::token() const { return source.get_token(); }

}  // namespace nacre::tool
