/* What calls give back, and what there is to say: part of <nacre/nacre.h>. */
#ifndef NACRE_REPORT_H
#define NACRE_REPORT_H

#include <nacre/version.h>
#include <stddef.h>
#include <stdint.h>

#define NACRE_API __attribute__((visibility("default")))

#ifdef __cplusplus
extern "C" {
#endif

/* -- Status and version ----------------------------------------------------------------- */

typedef int nacre_status;
enum {
  NACRE_OK = 0,
  NACRE_FAILED = 1,          /* The report says why. */
  NACRE_WRONG_ARGUMENTS = 2, /* A call that cannot be meant: an object that is NULL, a size of 0,
                                fewer arrays than were bound. Nothing was done. */
  NACRE_OUT_OF_MEMORY = 3,
  NACRE_STOPPED = 4,       /* nacre_batch::stop was not 0. The outputs hold anything. */
  NACRE_TOO_MANY_STEPS = 5 /* A loop of the document does not end. The outputs hold anything. */
};

/* NACRE_VERSION of the library that is running. */
NACRE_API uint32_t nacre_version(void);
/* "0.1.0" */
NACRE_API const char* nacre_version_text(void);

/* -- Stops: what ends a long call early ---------------------------------------------------- */

typedef struct nacre_stop nacre_stop;

NACRE_API nacre_status nacre_stop_create(nacre_stop** stop);
NACRE_API void nacre_stop_destroy(nacre_stop* stop);
/* By any thread, once and for all: calls that were given it end within about a tenth of a second,
   with an error in their reports. */
NACRE_API void nacre_stop_request(nacre_stop* stop);

/* -- Reports: what there is to say ------------------------------------------------------- */

typedef struct nacre_report nacre_report;

enum { NACRE_NOTE = 0, NACRE_WARNING = 1, NACRE_ERROR = 2 };

typedef struct nacre_diagnostic {
  size_t size;
  int severity;         /* NACRE_ERROR: something is not there, or not right. */
  const char* code;     /* Stable, "unknown-node". */
  const char* file;     /* "" where no place is known. */
  int line;             /* 1-based; 0: unknown. */
  int column;           /* 1-based; 0: unknown. */
  const char* path;     /* Of the element: "NG_marble/mix1/fg". */
  const char* message;  /* One sentence. */
  const char* expected; /* What would have been right; may be "". */
  const char* found;    /* What was there; may be "". */
  const char* text;     /* All of it in one printable line. */
  const char* hint;     /* Which names will have been meant by one that there is not; may be "". */
} nacre_diagnostic;

NACRE_API nacre_status nacre_report_create(nacre_report** report);
NACRE_API void nacre_report_destroy(nacre_report* report);
/* How many there are to get. */
NACRE_API size_t nacre_report_count(const nacre_report* report);
/* Errors of all that was said, those included that a long report no longer has. */
NACRE_API size_t nacre_report_error_count(const nacre_report* report);
NACRE_API nacre_status nacre_report_get(const nacre_report* report, size_t index,
                                        nacre_diagnostic* diagnostic);
NACRE_API void nacre_report_clear(nacre_report* report);
/* Calls with each diagnostic that a call adds, before that call returns and by its thread; the
   texts live during `said`, which NULL ends. */
NACRE_API void nacre_report_listen(nacre_report* report,
                                   void (*said)(void* user, const nacre_diagnostic* diagnostic),
                                   void* user);

#ifdef __cplusplus
}
#endif

#endif
