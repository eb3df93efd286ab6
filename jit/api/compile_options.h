#pragma once

#include <nacre/nacre.h>

#include <span>

#include "jit/shading/shading_system.h"

namespace nacre::api {

/// Whether all that a host asks of a compile means something; null is the defaults. Else an error
/// for each option that does not.
bool check_compile_options(const nacre_compile_options* given, Diagnostics& diagnostics);

/// Whether all lead from a document to the same graph; else an error. One at least.
bool check_one_graph(std::span<const nacre_compile_options* const> variants,
                     Diagnostics& diagnostics);

/// Of a document, as it is read: of options that have been checked.
ShaderOptions shader_options(const nacre_compile_options* given, const Document& document);

}  // namespace nacre::api
