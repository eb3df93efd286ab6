#pragma once

#include <functional>

namespace nacre::host {

/// While kernels are compiled that are interpreted meanwhile, interpreting takes cores from
/// compiling, which is worth more. So the last of `threads` threads, as many as are `pending`
/// (kernels that are being compiled), wait here; the first of all, `index` 0, never does.
/// Until `has_ended`.
void leave_cores(int index, int threads, const std::function<int()>& pending,
                 const std::function<bool()>& has_ended);

}  // namespace nacre::host
