#include "pbs/edf.h"

namespace nacre {

EdfPtr as_edf(const ClosurePtr& closure) { return std::dynamic_pointer_cast<const Edf>(closure); }

}  // namespace nacre
