/* The machine code of shaders, called without nacre_run: beside <nacre/nacre.h>.
 *
 * nacre_run gathers numbers from where a host has them, sets the floating-point environment, looks
 * for requests to stop and shades what is no whole pass: for a call with one point that takes as
 * long as the point. Hosts that have columns of numbers call the code itself.
 */
#ifndef NACRE_CODE_H
#define NACRE_CODE_H

#include <nacre/nacre.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An entry of a shader, with values of its parameters and images as they were then. */
typedef struct nacre_code nacre_code;

/* `inputs`, `outputs`: an array for each nacre_shader_input and nacre_shader_result of the entry,
   in their order, of `count` four-byte numbers; what is written must not overlap what is read.
   `count`: a multiple of nacre_code_lanes, else nothing is computed: NACRE_WRONG_ARGUMENTS. Only
   between nacre_enter and nacre_leave: otherwise the bits may be others. Any number of threads may
   call at once. */
typedef nacre_status (*nacre_function)(const nacre_code* code, const void* const* inputs,
                                       void* const* outputs, uint64_t count);

/* `single`: 1: for one point at a time, where nacre_compile_options::single_points asked for it.
   NACRE_FAILED, with the reason, where there is no machine code: yet, or because the entry is
   interpreted. Not of NACRE_EVALUATE_AT. It may outlive the shader. Of a shader with facts it is
   code that knows none, which is compiled then. */
NACRE_API nacre_status nacre_code_create(const nacre_shader* shader, nacre_entry entry,
                                         const nacre_instance* instance, int single,
                                         nacre_report* report, nacre_code** code);
NACRE_API void nacre_code_destroy(nacre_code* code);
/* Points of one pass: 1, 4, 8 or 16. */
NACRE_API int nacre_code_lanes(const nacre_code* code);
/* To be called with this code, and kept as long as it. */
NACRE_API nacre_function nacre_code_function(const nacre_code* code);

/* Gives the calling thread the floating-point environment that code runs in: rounded to nearest
   even, denormals are zero, no exceptions. Returns its own, which nacre_leave gives back. */
NACRE_API uint32_t nacre_enter(void);
NACRE_API void nacre_leave(uint32_t environment);

#ifdef __cplusplus
}
#endif

#endif
