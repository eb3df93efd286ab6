/// \file
/// <nacre/nacre.h> for C++17: objects that destroy themselves, errors as exceptions, what a host
/// has in strings and vectors. All of it is inline, so nothing here depends on the compiler that
/// libnacre.so was built with; the inline namespace keeps libraries apart that were compiled with
/// other versions of it.
#ifndef NACRE_NACRE_HPP
#define NACRE_NACRE_HPP

#include <nacre/binding.hpp>
#include <nacre/colors.hpp>
#include <nacre/diagnostic.hpp>
#include <nacre/document.hpp>
#include <nacre/hooks.hpp>
#include <nacre/record.hpp>
#include <nacre/shader.hpp>
#include <nacre/system.hpp>
#include <nacre/values.hpp>

#endif
