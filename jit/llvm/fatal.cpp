#include "jit/llvm/fatal.h"

#include <llvm-c/ErrorHandling.h>

namespace nacre {

void on_llvm_fatal(void (*end)(const char* reason)) { LLVMInstallFatalErrorHandler(end); }

}  // namespace nacre
