#pragma once

#include <cstdint>
#include <string>

#include "tests/support/tier.h"

namespace nacre {

/// T-SPEC of the document of a seed, at `standard` or `precise` (NACRE_STANDARD ...): kernels whose
/// constants are folded in and whose dark parts are left out against those of which every parameter
/// may change, and against those to which every parameter comes with the point; machine code
/// against the interpreter. What is left out is in the manifest. Fails the running test.
void try_document(std::uint64_t seed, int accuracy, bool by_machine_code);

/// The same of material M of that text; directions are the seed's.
void try_material(const std::string& text, std::uint64_t seed, int accuracy, bool by_machine_code);

}  // namespace nacre
