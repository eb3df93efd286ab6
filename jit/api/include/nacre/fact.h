/* What a host knows of numbers that kernels read: part of <nacre/nacre.h>. */
#ifndef NACRE_FACT_H
#define NACRE_FACT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is known of numbers that kernels read. Kernels leave out what cannot happen then, and have
   the same bits: clamps, branches, lobes of weight 0. They look whether it is so; points of which
   it is not, and some beside them, are computed as if nothing had been said, by kernels that are
   made when they are first needed, of NACRE_FAST with the others. */
typedef struct nacre_fact {
  /* A channel, "uv0.x", or all of a group, "uv0"; what is live, "SR_gold/coat", or one number of
     it, "SR_gold/coat_color.x"; or the scalar product of two groups, "dot(N,wo)". Kernels that do
     not read it do not mind. */
  const char* name;
  double minimum; /* None is less; from 0 on -0 is. */
  double maximum; /* None is more, and none is NaN. */
} nacre_fact;

/* One of nacre_compile_options::facts. */
typedef struct nacre_fact_info {
  size_t size;
  const char* name;
  double minimum;
  double maximum;
  /* Instructions that the shader's kernels have less for it, beside what all other facts leave out;
     NACRE_NOT_KNOWN where code was in the cache, and of parameters where there are too many to
     try each. */
  uint64_t saved;
} nacre_fact_info;

#define NACRE_NOT_KNOWN UINT64_MAX

#ifdef __cplusplus
}
#endif

#endif
