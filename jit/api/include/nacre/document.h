/* MaterialX documents, their elements and looks: part of <nacre/nacre.h>. */
#ifndef NACRE_DOCUMENT_H
#define NACRE_DOCUMENT_H

#include <nacre/hooks.h>
#include <nacre/report.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nacre_document nacre_document;

typedef struct nacre_read_options {
  size_t size;
  const char* const* search_paths; /* Of includes, after the including file's own folder. */
  size_t search_path_count;
  int includes_anywhere;    /* 1: also outside the main file's folder and the search paths. */
  uint64_t max_file_bytes;  /* Of one file. 0: 64 MiB. */
  uint64_t max_total_bytes; /* Of all files of the document. 0: 256 MiB. */
  uint64_t max_elements;    /* In one file. 0: 4,000,000. */
  int max_files;            /* The document with its includes. 0: 1024. */
  int max_include_depth;    /* Files that include one another. 0: 256. */
  int max_xml_depth;        /* Elements within one another. 0: 256. */
  int max_inheritance; /* Nodedefs, nodes, looks or types that inherit from one another. 0: 64. */
  const nacre_stop* stop;              /* NULL: never. */
  const nacre_file_resolver* resolver; /* Of includes; NULL: none. Called by this call alone, which
                                          does not destroy it. */
} nacre_read_options;

NACRE_API nacre_status nacre_document_read(const char* file, const nacre_read_options* options,
                                           nacre_report* report, nacre_document** document);
/* Of text in memory, which need not end with 0. `name` stands for the file in diagnostics, and its
   folder is where includes and images are looked for. */
NACRE_API nacre_status nacre_document_parse(const char* text, size_t length, const char* name,
                                            const nacre_read_options* options, nacre_report* report,
                                            nacre_document** document);
NACRE_API void nacre_document_destroy(nacre_document* document);
/* Material nodes, in the document's order. */
NACRE_API size_t nacre_document_material_count(const nacre_document* document);
NACRE_API const char* nacre_document_material(const nacre_document* document, size_t index);
/* Outputs of the document and its node graphs that can be kernels: "NG_marble/out". */
NACRE_API size_t nacre_document_output_count(const nacre_document* document);
NACRE_API const char* nacre_document_output(const nacre_document* document, size_t index);

/* -- Elements: what the document says, after includes and upgrades to MaterialX 1.39 ---------- */

/* An element, by its number in the order of the document; 0 is the root. Its children are the
   number behind it, the `end` of that one, and so on up to its own `end`. */
typedef struct nacre_element {
  size_t size;
  const char* category; /* "nodegraph", "standard_surface" */
  const char* name;     /* "" without one. */
  size_t parent;        /* SIZE_MAX for the root. */
  size_t end;           /* Behind the last element within it. */
  size_t attribute_count;
  const char* file; /* That it was written in. */
  int line;         /* 1-based. */
  int column;       /* 1-based. */
} nacre_element;

/* 0 where there is no memory to list them. */
NACRE_API size_t nacre_document_element_count(const nacre_document* document);
NACRE_API nacre_status nacre_document_element(const nacre_document* document, size_t index,
                                              nacre_element* element);
/* The number of the element of a path, "NG_marble/mix1/fg"; "": the root. SIZE_MAX: none. */
NACRE_API size_t nacre_document_find_element(const nacre_document* document, const char* path);
/* Name and value of an attribute, the name counted among the others; either may be NULL. */
NACRE_API nacre_status nacre_document_attribute(const nacre_document* document, size_t element,
                                                size_t index, const char** name,
                                                const char** value);
/* The value of an attribute by its name; NULL if the element does not have it. */
NACRE_API const char* nacre_document_find_attribute(const nacre_document* document, size_t element,
                                                    const char* name);

/* -- Looks: which material is where (MaterialX 1.39 Geometry Extensions) ---------------------- */

/* The variant of a set that is applied; see nacre_compile_options::variants. */
typedef struct nacre_variant {
  const char* set;
  const char* variant;
} nacre_variant;

NACRE_API size_t nacre_document_look_count(const nacre_document* document);
NACRE_API const char* nacre_document_look(const nacre_document* document, size_t index);

typedef struct nacre_assignment {
  size_t size;
  const char* material; /* "" where the look assigns none. */
  /* The look's and the assignment's, in the order in which they are applied. */
  const nacre_variant* variants;
  size_t variant_count;
} nacre_assignment;

/* What a look assigns to the geometry of a full path, "/house/door/knob". Lives as long as the
   document. Assignments to paths above hold, unless there is a nearer one. */
NACRE_API nacre_status nacre_document_assignment(const nacre_document* document, size_t look,
                                                 const char* geometry,
                                                 nacre_assignment* assignment);
/* 1 if the geometry is seen by rays of a kind: "camera", "illumination", "shadow", "secondary";
   "": any. `viewer`: the geometry that they come from; NULL or "": none. */
NACRE_API int nacre_document_is_visible(const nacre_document* document, size_t look,
                                        const char* geometry, const char* rays, const char* viewer);

#ifdef __cplusplus
}
#endif

#endif
