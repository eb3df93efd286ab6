/* Channels, what kernels read and store: part of <nacre/nacre.h>. */
#ifndef NACRE_CHANNEL_H
#define NACRE_CHANNEL_H

#include <nacre/report.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of a channel's numbers, four bytes each: float, int32, or int32 that is 0 or 1. */
enum { NACRE_FLOAT = 0, NACRE_INT = 1, NACRE_BOOL = 2 };

/* Who gives a channel its numbers. */
enum {
  NACRE_POINT = 0,     /* The host, of the shading point. */
  NACRE_DIRECTION = 1, /* The host, of what it asks about the point: wi, u. */
  NACRE_STATE = 2,     /* NACRE_BEGIN, for the other entries of a material. */
  NACRE_RESULT = 3,    /* A kernel, for the host. */
  NACRE_SLOT = 4,      /* An instance, for all points; or the host, if it is varying. */
  NACRE_VALUE = 5      /* A kernel: an output of a node graph. */
};

/* Channels of one meaning, "<name>.x", "<name>.y", ... */
typedef struct nacre_channel_group {
  size_t size;
  const char* name; /* "P"; "uv*", where * is a number, "geomprop.*", where it is a name. */
  int role;
  int components; /* 1: the name alone. */
  int type;
  const char* unit;    /* "scene units", "unit vector"; "": a bare number. */
  const char* meaning; /* One phrase. */
} nacre_channel_group;

NACRE_API size_t nacre_channel_group_count(void);
NACRE_API nacre_status nacre_channel_group_get(size_t index, nacre_channel_group* group);

/* A channel of one kernel. */
typedef struct nacre_channel {
  size_t size;
  const char* name; /* "P.x" */
  int component;    /* 0 to 3 for .x to .w; -1: none; of "state.<k>" its place in the state. */
  int type;
  int role;
  const char* unit;    /* Of the group, or "". */
  const char* meaning; /* Of the group, or "". */
} nacre_channel;

#ifdef __cplusplus
}
#endif

#endif
