#pragma once

namespace nacre {

/// What LLVM calls, once, where it cannot go on, and after which it ends the process; for
/// a process that does nothing else. The reason is a line of English.
void on_llvm_fatal(void (*end)(const char* reason));

}  // namespace nacre
