/* Laws that every closure must hold, tried on a compiled material: for the tests of hosts that
 * write lobes, and for anybody who wants to know what a material does with light. Not part of
 * <nacre/nacre.h>; <nacre/lobe_test.hpp> is the same for C++17.
 */
#ifndef NACRE_LOBE_TEST_H
#define NACRE_LOBE_TEST_H

#include <nacre/nacre.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nacre_lobe_test_options {
  size_t size;
  /* Where the material is looked at from: `wo_count` unit vectors, normal z, tangent x. NULL: 0,
     30, 60, 80 and 85 degrees from the normal, towards x. */
  const float (*wo)[3];
  size_t wo_count;
  uint64_t samples;               /* Of each wo. 0: 100,000. */
  uint64_t seed;                  /* The same samples each time: a fault comes again. 0: 1. */
  double most_energy;             /* What may leave of the light that arrives. 0: 1.01. */
  double albedo_error;            /* Of what NACRE_ALBEDO says, absolute. 0: 1e-2. */
  double weight_error;            /* Of densities and weights, relative. 0: 1e-4. */
  double unit_error;              /* Of the squared length of wi. 0: 1e-3. */
  const nacre_instance* instance; /* NULL: the document's values. */
  /* Binds what else the material reads; NULL: all other channels are 0. */
  void (*bind)(void* user, nacre_binder* binder);
  void* bind_user;
} nacre_lobe_test_options;

/* A law that does not hold. */
typedef struct nacre_lobe_fault {
  size_t size;
  /* "finite": f, pdf, weights and directions are, and none of the numbers is negative. "lost": a
     sample that is not valid has weight and density 0. "unit": wi is. "flags": those of the side
     that wi is on. "sides": most samples are where the lobes' kinds say. "density": NACRE_SAMPLE
     and NACRE_EVALUATE say the same. "weight": f / pdf. "support": f is 0 where pdf is.
     "normalised": pdf integrates to the fraction of valid samples. "samples": they follow the
     density. "light": the mean weight is the integral of f. "energy": no more leaves than arrives.
     "albedo": that is what NACRE_ALBEDO says. */
  const char* law;
  float wo[3];
  double found;
  double expected;
  const char* text; /* All of it, in a line. */
} nacre_lobe_fault;

/* What leaves of the light from one direction. */
typedef struct nacre_lobe_view {
  size_t size;
  float wo[3];
  double energy[3];  /* Mean weight of the samples: red, green and blue. */
  double deviation;  /* Of that mean, of the channel where it is the largest. */
  double albedo[3];  /* What NACRE_ALBEDO says. */
  double valid;      /* Fraction of the samples. */
  double chi_square; /* Probability of samples at least as far from the density. */
  /* The greatest ratio of what scatters one way to what scatters the other: 1 for what is
     reciprocal, as models need not be. */
  double reciprocity;
  /* 1: more than a 10,000th of the samples, and two of them, fall where the density is far more
     than its quadrature has seen, as of facets that are rough one way and smooth the other:
     "normalised", "samples" and "light" are not tried. */
  int is_too_thin;
} nacre_lobe_view;

typedef struct nacre_lobe_report nacre_lobe_report;

/* Looks at a material from each direction. All laws hold by chance in 999 of 1000 seeds where there
   is no fault. NACRE_OK: it was tried, with what faults there are in `found`.
   NACRE_WRONG_ARGUMENTS: also where the shader lacks NACRE_SAMPLE, NACRE_EVALUATE or NACRE_ALBEDO.
 */
NACRE_API nacre_status nacre_test_lobes(const nacre_shader* shader,
                                        const nacre_lobe_test_options* options,
                                        nacre_report* report, nacre_lobe_report** found);
NACRE_API void nacre_lobe_report_destroy(nacre_lobe_report* found);

/* At most one of each law for each view. */
NACRE_API size_t nacre_lobe_report_fault_count(const nacre_lobe_report* found);
NACRE_API nacre_status nacre_lobe_report_fault(const nacre_lobe_report* found, size_t index,
                                               nacre_lobe_fault* fault);
/* One for each wo. */
NACRE_API size_t nacre_lobe_report_view_count(const nacre_lobe_report* found);
NACRE_API nacre_status nacre_lobe_report_view(const nacre_lobe_report* found, size_t index,
                                              nacre_lobe_view* view);

#ifdef __cplusplus
}
#endif

#endif
