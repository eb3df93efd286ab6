#pragma once

#include <memory>

#include "jit/service/compile_service.h"

namespace nacre {

/// One kernel of two: runs of few points take the code of one lane. Both are of the same Program,
/// and give the same bits. Pending as long as one of them is.
std::shared_ptr<CompiledKernel> of_two_widths(std::shared_ptr<CompiledKernel> wide,
                                              std::shared_ptr<CompiledKernel> single);

}  // namespace nacre
