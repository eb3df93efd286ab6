/* What a host may do in place of the library: part of <nacre/nacre.h>.
 *
 * All of it is optional. The functions may be called by any thread, by several at once; those that
 * a batch calls run with denormals flushed to zero. None may throw. `user` is the host's;
 * `destroy`, which may be NULL, is called when nothing can call the others any more: at once where
 * the system cannot be made, but not where that is NACRE_WRONG_ARGUMENTS.
 */
#ifndef NACRE_HOOKS_H
#define NACRE_HOOKS_H

#include <nacre/report.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* -- Files: archives, asset systems ---------------------------------------------------------- */

enum { NACRE_INCLUDE = 0, NACRE_IMAGE = 1 }; /* What a document names a file for. */

/* Where a file is: at a path, wherever that lies, or in memory. */
typedef struct nacre_file {
  size_t size;
  const char* path;  /* Of contents in memory: what they are called. */
  const void* bytes; /* The contents, which are copied before the next call by the thread; NULL:
                        those of the file. */
  size_t byte_count;
} nacre_file;

/* Asked before a file is looked for. */
typedef struct nacre_file_resolver {
  size_t size;
  void* user;
  /* 1, and the file; or 0: it is looked for as usual. `name` as the document has it, with <UDIM>
     too, which must lead to a path; `named_by` the document's own. */
  int (*resolve)(void* user, const char* name, const char* named_by, int what, nacre_file* file);
  void (*destroy)(void* user);
} nacre_file_resolver;

/* -- Images ------------------------------------------------------------------------------------ */

/* Of samples; unsigned ones are fractions of the largest. */
enum { NACRE_UINT8 = 0, NACRE_UINT16 = 1, NACRE_HALF = 2, NACRE_FLOAT32 = 3 };

/* An image in memory, its top row first, its channels together. */
typedef struct nacre_image {
  size_t size;
  int width;
  int height;
  int channels; /* 1 to 4. */
  int samples;  /* NACRE_UINT8 and so on. */
  const void* pixels;
  ptrdiff_t row_bytes; /* From one row to the next; 0: as long as a row. */
} nacre_image;

enum { NACRE_CLOSEST = 0, NACRE_LINEAR = 1, NACRE_CUBIC = 2 };
enum { NACRE_CONSTANT = 0, NACRE_CLAMP = 1, NACRE_PERIODIC = 2, NACRE_MIRROR = 3 };

/* Lookups of one call: arrays of `count`. (0, 0) is the lower left corner. */
typedef struct nacre_texture_lookup {
  size_t size;
  int count;
  const float* u;
  const float* v;
  /* Of u and v, from one sample to the next along x and y; all may be NULL, for 0. */
  const float* dudx;
  const float* dvdx;
  const float* dudy;
  const float* dvdy;
  int filter; /* NACRE_CLOSEST and so on. */
  int u_mode; /* Where u is outside [0, 1]: NACRE_CONSTANT and so on; what is constant is filled in
                 by the caller. */
  int v_mode;
  int max_anisotropy;
} nacre_texture_lookup;

/* An image of the host's own. */
typedef struct nacre_opened_image {
  size_t size;
  void* image; /* The host's, given back to the functions. */
  int width;   /* In pixels. */
  int height;
} nacre_opened_image;

/* Looks images up in place of the library. */
typedef struct nacre_texture_system {
  size_t size;
  void* user;
  /* 1, and the image; or 0: it is read as a file. By its name, resolved, and layer, "" if none. */
  int (*open)(void* user, const char* name, const char* layer, nacre_opened_image* image);
  /* Red, green, blue and alpha into four arrays of `count`. What is no finite number becomes 0. */
  void (*look_up)(void* user, void* image, const nacre_texture_lookup* lookup, float* const* rgba);
  void (*close)(void* user, void* image); /* Once for each that was opened; may be NULL. */
  void (*destroy)(void* user);
} nacre_texture_system;

/* -- Threads and memory -------------------------------------------------------------------------
 */

/* Runs what compiles, in place of threads of the library's. */
typedef struct nacre_executor {
  size_t size;
  void* user;
  /* Has run(task) called once, soon, by a thread with a stack of 16 MiB, or any if
     nacre_system_options::compile_apart. Calls that compile wait for it, so the last thread that
     runs tasks must not make them. */
  void (*submit)(void* user, void (*run)(void* task), void* task);
  void (*destroy)(void* user);
} nacre_executor;

/* Where the texels of images in memory lie. */
typedef struct nacre_allocator {
  size_t size;
  void* user;
  void* (*allocate)(void* user, size_t bytes); /* On a boundary of 64; NULL: there is no memory. */
  void (*release)(void* user, void* block, size_t bytes);
  void (*destroy)(void* user);
} nacre_allocator;

#ifdef __cplusplus
}
#endif

#endif
