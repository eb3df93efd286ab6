/* Node definitions that documents of a system may use: part of <nacre/nacre.h>. */
#ifndef NACRE_LIBRARY_H
#define NACRE_LIBRARY_H

#include <nacre/report.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nacre_system nacre_system;

/* The folder of the MaterialX data library that was installed with libnacre.so; "" if it is not
   there. The environment variable NACRE_MATERIALX_LIBRARIES counts before it. */
NACRE_API const char* nacre_data_library(void);

typedef struct nacre_nodedef {
  size_t size;
  const char* name;     /* "ND_mix_color3" */
  const char* category; /* "mix" */
  const char* group;    /* "compositing"; "" if not said. */
  const char* version;  /* "" for one without versions. */
  const char* document; /* What it says of itself, or "". */
  size_t input_count;
  size_t output_count;
  /* 1: a body of ours or the host's computes it; 0: its node graph or text does, or nothing. */
  int has_body;
} nacre_nodedef;

/* An input or output of a nodedef; of a structure, a leaf: "in.ss". */
typedef struct nacre_port {
  size_t size;
  const char* name;
  const char* type;     /* "color3" */
  const char* value;    /* The default as the nodedef has it, or "". */
  const char* geomprop; /* The geometric property that is the default: "Nworld"; or "". */
  const char* label;    /* uiname, or "". */
  const char* folder;   /* uifolder, or "". */
  const char* unit;     /* Or "". */
  const char* document; /* What the nodedef says of it, or "". */
  int is_uniform;       /* 1: never varies over a surface. */
} nacre_port;

/* Those of the libraries, by the order of their files. */
NACRE_API size_t nacre_system_nodedef_count(const nacre_system* system);
NACRE_API nacre_status nacre_system_nodedef(const nacre_system* system, size_t index,
                                            nacre_nodedef* nodedef);
/* The index of the one of that name, or SIZE_MAX. */
NACRE_API size_t nacre_system_find_nodedef(const nacre_system* system, const char* name);
NACRE_API nacre_status nacre_system_input(const nacre_system* system, size_t nodedef, size_t index,
                                          nacre_port* port);
NACRE_API nacre_status nacre_system_output(const nacre_system* system, size_t nodedef, size_t index,
                                           nacre_port* port);

#ifdef __cplusplus
}
#endif

#endif
