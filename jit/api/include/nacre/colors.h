/* Colour spaces that a host defines: part of <nacre/nacre.h>. */
#ifndef NACRE_COLORS_H
#define NACRE_COLORS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nacre_color_space {
  size_t size;
  const char* name; /* The space's own, whatever name it was found by. */
  int is_data;      /* 1: numbers that are no colours; they are never converted. */
} nacre_color_space;

/* Numbers that a transform looks up, a texture of one to three dimensions. */
typedef struct nacre_color_table {
  size_t size;
  const char* name;    /* Of the uniform sampler in the text. */
  size_t extent[3];    /* Texels along x, y, z; all at least 1. */
  size_t channels;     /* 1 to 4; what is missing reads as (0, 0, 0, 1). */
  int is_nearest;      /* 1: the nearest texel; 0: linear between their centres. */
  const float* values; /* The channels of a texel side by side, then x, y, z. */
} nacre_color_table;

/* How colours of one space become those of another. Is copied before the next call. */
typedef struct nacre_color_transform {
  size_t size;
  const char* text;     /* GLSL that defines `vec4 function(vec4 rgba)`. */
  const char* function; /* Its name in the text. */
  const nacre_color_table* tables;
  size_t table_count;
} nacre_color_transform;

/* Looked at before the spaces that are built in. The functions may be called by any thread, by
   several at once; the structures that they fill in are all 0 but for their sizes. */
typedef struct nacre_colors {
  size_t size;
  const char* name; /* For diagnostics. */
  void* user;
  /* 1, and the space, if there is one of that name. Asked for by us, not by documents, are
     "lin_rec709", "scene_linear" and "aces_interchange", which is to be ACES 2065-1. */
  int (*find)(void* user, const char* name, nacre_color_space* space);
  /* Between two spaces' own names: 1, or 0 if there is none. */
  int (*transform)(void* user, const char* from, const char* to, nacre_color_transform* transform);
  void (*destroy)(void* user); /* With the last shader of the system; may be NULL. */
} nacre_colors;

#ifdef __cplusplus
}
#endif

#endif
