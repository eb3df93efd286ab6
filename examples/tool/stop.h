#pragma once

#include <string>
#include <vector>

#include "runtime/stop.h"

namespace nacre::tool {

/// While it lives, SIGINT (Ctrl-C), SIGTERM and SIGHUP ask the work to stop, by `stop()`.
/// Work that cannot look at that, as LLVM's, is not waited for: after 0.3 s, or at a second
/// signal, the process ends by `end_stopped`. One for the program.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
};

/// Due once a signal asks for it; never where there is no StopOnSignal.
Stop stop();

/// Says which files the work at hand is to write, and that one is written: what is missing
/// is named if the work is stopped. Names that are empty are of no file.
void promise_files(const std::vector<std::string>& files);
void keep_promise(const std::string& file);
/// That it is not to be written after all.
void withdraw_promise(const std::string& file);
/// That one is written but is not all that was asked for, and what it is instead.
void keep_promise_partly(const std::string& file, const std::string& what);

/// How long work may take to stop and to write what there is, in place of 0.3 s.
void take_time_to_stop(double seconds);

/// True if a signal came and any file that was promised is missing, or not whole.
bool is_stopped_early();

/// Removes partial files, says what is missing and ends the process by the signal that
/// came, which shells call 128 + its number. Callable from any thread; waits for none.
[[noreturn]] void end_stopped();

}  // namespace nacre::tool
