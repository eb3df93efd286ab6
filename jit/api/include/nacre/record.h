/* Nodes and lobes that a host writes: part of <nacre/nacre.h>.
 *
 * A body is a function that runs once for each node of a graph, when a kernel is made. It computes
 * on recorded values in place of numbers; the operations that it records become part of the kernel.
 * <nacre/record.hpp> lets them look like floats.
 *
 * What a body does wrong (operands of another type, values of another recording, an output that is
 * not there) is an error in the report of the call that compiles, at the node; the body goes on
 * with zeros.
 */
#ifndef NACRE_RECORD_H
#define NACRE_RECORD_H

#include <nacre/report.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nacre_recorder nacre_recorder; /* Where the operations of one graph go. */
typedef struct nacre_node nacre_node;         /* A node whose body is running, and no longer. */

/* A recorded float, integer or truth value. One with no recorder is a literal: `bits` are its own,
   and operations on literals alone are computed at once. */
typedef struct nacre_value {
  nacre_recorder* recorder;
  uint32_t bits;
  int type; /* NACRE_FLOAT, NACRE_INT or NACRE_BOOL. */
} nacre_value;

NACRE_API nacre_value nacre_literal_float(float value);
NACRE_API nacre_value nacre_literal_int(int32_t value);
NACRE_API nacre_value nacre_literal_bool(int value);

/* Operations: f floats, i integers, b truth values. */
typedef enum nacre_operation {
  /* f -> f; every one rounds once, denormals are 0, NaN is one. */
  NACRE_ADD = 0,
  NACRE_SUB = 1,
  NACRE_MUL = 2,
  NACRE_DIV = 3,
  NACRE_FMA = 4, /* a b + c, rounded once. */
  NACRE_MIN = 5, /* a < b ? a : b, so b where either is NaN. */
  NACRE_MAX = 6,
  NACRE_SQRT = 7,
  NACRE_NEG = 8,
  NACRE_ABS = 9,
  NACRE_FLOOR = 10,
  NACRE_CEIL = 11,
  NACRE_TRUNC = 12,
  NACRE_ROUND = 13, /* Ties to even. */
  /* f f -> b; all but NE are false where either is NaN. */
  NACRE_EQ = 14,
  NACRE_NE = 15,
  NACRE_LT = 16,
  NACRE_LE = 17,
  /* i -> i; modulo 2^32, shifts by the low five bits. */
  NACRE_IADD = 18,
  NACRE_ISUB = 19,
  NACRE_IMUL = 20,
  NACRE_UMULHI = 21, /* The high half of the unsigned product. */
  NACRE_IAND = 22,
  NACRE_IOR = 23,
  NACRE_IXOR = 24,
  NACRE_SHL = 25,
  NACRE_LSHR = 26,
  NACRE_ASHR = 27,
  /* i i -> b */
  NACRE_IEQ = 28,
  NACRE_ILT = 29,
  NACRE_ULT = 30, /* Unsigned. */
  /* b -> b */
  NACRE_AND = 31,
  NACRE_OR = 32,
  NACRE_XOR = 33,
  NACRE_NOT = 34,
  NACRE_SELECT = 35, /* (b, x, x): both sides are computed. */
  /* Conversions. */
  NACRE_F_TO_I = 36, /* Toward zero, clamped; NaN gives 0. */
  NACRE_I_TO_F = 37,
  NACRE_U_TO_F = 38,
  NACRE_BITS = 39,
  NACRE_FROM_BITS = 40,
  NACRE_B_TO_I = 41,
  /* f -> f as the C library's, as exact as the accuracy asks. */
  NACRE_SIN = 42,
  NACRE_COS = 43,
  NACRE_TAN = 44,
  NACRE_ASIN = 45,
  NACRE_ACOS = 46,
  NACRE_ATAN2 = 47, /* (y, x) */
  NACRE_EXP = 48,
  NACRE_EXP2 = 49,
  NACRE_LOG = 50,
  NACRE_LOG2 = 51,
  NACRE_POW = 52,
  NACRE_LOOK_UP = 53,   /* (i): entry of the table that nacre_table gave; the index is clamped. */
  NACRE_DERIVATIVE = 54 /* Along the axis of the point's footprint, 0 for x, 1 for y. */
} nacre_operation;

/* `immediate`: the table of NACRE_LOOK_UP, the axis of NACRE_DERIVATIVE; else 0. */
NACRE_API nacre_value nacre_record(nacre_operation operation, const nacre_value* operands,
                                   size_t count, uint32_t immediate);

/* -- The node ---------------------------------------------------------------------------------- */

NACRE_API nacre_recorder* nacre_node_recorder(nacre_node* node);
NACRE_API const char* nacre_node_nodedef(const nacre_node* node);
NACRE_API int nacre_node_accuracy(const nacre_node* node);
/* "color3"; "" for an input that the nodedef does not have. */
NACRE_API const char* nacre_node_input_type(const nacre_node* node, const char* name);
/* How many numbers an input has; at most `room` are written to `values`. Matrices row by row. */
NACRE_API size_t nacre_node_input(nacre_node* node, const char* name, nacre_value* values,
                                  size_t room);
/* Of a string, filename or geomname; "" for others. */
NACRE_API const char* nacre_node_text(nacre_node* node, const char* name);
/* Of the output of that name; NULL: the first. */
NACRE_API const char* nacre_node_output_type(const nacre_node* node, const char* name);
NACRE_API void nacre_node_set(nacre_node* node, const char* output, const nacre_value* values,
                              size_t count);
/* Something that the body cannot do: keeps the kernel from being made. */
NACRE_API void nacre_node_error(nacre_node* node, const char* message);

/* -- Leaves --------------------------------------------------------------------------------------
 */

/* A channel of the batch: "P.x", or one of the host's own. */
NACRE_API nacre_value nacre_read_channel(nacre_recorder* recorder, const char* name, int type);
/* A number that an instance sets, with what it is until then. */
NACRE_API nacre_value nacre_read_slot(nacre_recorder* recorder, const char* name,
                                      nacre_value literal);
/* For NACRE_LOOK_UP. Tables of one name with the same numbers are one. */
NACRE_API uint32_t nacre_table(nacre_recorder* recorder, const char* name, const float* values,
                               size_t count);
/* Marks what begin stores for the kernels after it; gives the value to go on with. Outside regions
   and functions. */
NACRE_API nacre_value nacre_keep(nacre_recorder* recorder, nacre_value value);

/* -- Regions --------------------------------------------------------------------------------------
 */

/* What is recorded until nacre_end_if is computed where any point needs it; of it nothing can be
   used behind but merges: `inside` where the mask is true, `outside` (of before) elsewhere. */
NACRE_API void nacre_begin_if(nacre_recorder* recorder, nacre_value mask);
NACRE_API nacre_value nacre_merge(nacre_recorder* recorder, nacre_value inside,
                                  nacre_value outside);
NACRE_API void nacre_end_if(nacre_recorder* recorder);

/* Repeats at most `bound` times what is recorded until nacre_end_loop, in the points where `mask`
   is true and nacre_again was, too. In order: carries, the body, a nacre_next for each carry (which
   gives its value behind the loop), nacre_again. */
NACRE_API void nacre_begin_loop(nacre_recorder* recorder, nacre_value mask, uint32_t bound);
NACRE_API nacre_value nacre_carry(nacre_recorder* recorder, nacre_value initial);
NACRE_API nacre_value nacre_next(nacre_recorder* recorder, nacre_value carry, nacre_value value);
NACRE_API void nacre_again(nacre_recorder* recorder, nacre_value goes_on);
NACRE_API void nacre_end_loop(nacre_recorder* recorder);

/* -- Lobes
 * --------------------------------------------------------------------------------------------- */

/* From where a lobe is looked at; lives during the call. */
typedef struct nacre_view {
  size_t size;
  nacre_recorder* recorder;
  nacre_value wo[3]; /* Unit, world space, from the point to the viewer. */
  int accuracy;
  nacre_value thin_walled; /* Light that enters leaves at the same point. */
} nacre_view;

/* A direction that a lobe chose. */
typedef struct nacre_lobe_sample {
  size_t size;
  nacre_value wi[3];             /* Unit, world space. */
  nacre_value valid;             /* False: the sample is lost. */
  nacre_value delta;             /* wi is one of finitely many; evaluate gives 0 there. */
  nacre_value delta_weight[3];   /* Only then: f cos / probability of the choice. */
  nacre_value delta_probability; /* Only then. */
} nacre_lobe_sample;

/* One term of a BSDF, of weight 1. Its functions record; `user` is the host's, with the values that
   the body prepared and kept. */
typedef struct nacre_lobe {
  size_t size;
  const char* name;
  int kinds;     /* NACRE_DIFFUSE_REFLECTION and so on. */
  int is_opaque; /* 1: nothing passes to layers below, whatever the weight. */
  void* user;
  void (*destroy)(void* user); /* May be NULL. */
  /* f is the scattering function times |cos(wi)|, pdf the density of wi by solid angle. */
  void (*evaluate)(void* user, const nacre_view* view, const nacre_value wi[3], nacre_value f[3],
                   nacre_value* pdf);
  /* u: three independent numbers in [0, 1). */
  void (*sample)(void* user, const nacre_view* view, const nacre_value u[3],
                 nacre_lobe_sample* sample);
  /* Fraction of the light from wo that leaves again, in [0, 1]. */
  void (*albedo)(void* user, const nacre_view* view, nacre_value rgb[3]);
  /* What passes to a layer below. NULL: 1 - albedo, or 0 where opaque. */
  void (*throughput)(void* user, const nacre_view* view, nacre_value rgb[3]);
  /* For renderers' images of normals: unit, world space. NULL: the shading normal. */
  void (*normal)(void* user, const nacre_view* view, nacre_value xyz[3]);
  /* And of roughness, in [0, 1]. NULL: 1. */
  void (*roughness)(void* user, const nacre_view* view, nacre_value* roughness);
} nacre_lobe;

/* Sets the node's first output, a BSDF, to the lobe times its input "weight". */
NACRE_API void nacre_node_set_lobe(nacre_node* node, const nacre_lobe* lobe);

/* A nodedef that the host implements; see nacre_system_options. */
typedef struct nacre_body {
  size_t size;
  const char* nodedef; /* Declared by one of the libraries. */
  void* user;
  void (*record)(void* user, nacre_node* node); /* By any thread that compiles. */
  void (*destroy)(void* user);                  /* With the system; may be NULL. */
} nacre_body;

#ifdef __cplusplus
}
#endif

#endif
