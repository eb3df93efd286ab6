/* Shades one texture of a MaterialX document, in C: a batch of points along its diagonal.
 *
 *   c_host DOCUMENT.mtlx OUTPUT
 */
#include <nacre/nacre.h>
#include <stdio.h>
#include <string.h>

enum { points = 8 };

/* Prints what there is to say, and gives the exit status of a host that goes no further. */
static int fail(const nacre_report* report) {
  size_t i;
  for (i = 0; i < nacre_report_count(report); ++i) {
    nacre_diagnostic said = {.size = sizeof said};
    if (nacre_report_get(report, i, &said) == NACRE_OK) fprintf(stderr, "%s\n", said.text);
  }
  return 1;
}

int main(int argc, char** argv) {
  nacre_report* report = NULL;
  nacre_system* system = NULL;
  nacre_document* document = NULL;
  nacre_shader* shader = NULL;
  nacre_binder* binder = NULL;
  nacre_binding* binding = NULL;
  float uv[points][2], color[points][3];
  const float forward[3] = {0, 0, 1};
  void* arrays[2];
  int i, status = 1;

  if (argc != 3) return fprintf(stderr, "usage: c_host DOCUMENT OUTPUT\n"), 2;
  memset(color, 0, sizeof color);
  for (i = 0; i < points; ++i) uv[i][0] = uv[i][1] = (float)i / points;

  if (nacre_report_create(&report) != NACRE_OK) return 1;
  /* What goes wrong in LLVM then costs a kernel its speed, not this program its life. */
  nacre_system_options options = {.size = sizeof options};
  options.compile_apart = 1;
  if (nacre_system_create(&options, report, &system) != NACRE_OK ||
      nacre_document_read(argv[1], NULL, report, &document) != NACRE_OK) {
    status = fail(report);
    goto end;
  }
  const char* const outputs[1] = {argv[2]};
  if (nacre_compile_outputs(system, document, outputs, 1, NULL, report, &shader) != NACRE_OK ||
      nacre_binder_create(&binder) != NACRE_OK) {
    status = fail(report);
    goto end;
  }

  /* Where the numbers are, once: arrays 0 and 1, as structures. What else a graph may ask of the
     points is the same for all of them here. */
  nacre_layout layout = {.size = sizeof layout};
  layout.stride = sizeof uv[0];
  layout.component_stride = sizeof uv[0][0];
  nacre_binder_array(binder, "uv0", &layout);
  layout.array = 1;
  layout.stride = sizeof color[0];
  nacre_binder_array(binder, argv[2], &layout);
  const char* const others[] = {"P",      "Po",     "T",    "To",   "B",     "Bo",
                                "duv0dx", "duv0dy", "dPdx", "dPdy", "dPodx", "dPody"};
  const float zero[3] = {0, 0, 0};
  for (i = 0; i < (int)(sizeof others / sizeof others[0]); ++i) {
    nacre_binder_constant(binder, others[i], zero, 3);
  }
  const char* const normals[] = {"N", "No", "Ng", "wo"};
  for (i = 0; i < 4; ++i) nacre_binder_constant(binder, normals[i], forward, 3);
  if (nacre_binding_create(binder, shader, 0, report, &binding) != NACRE_OK) {
    status = fail(report);
    goto end;
  }

  nacre_batch batch = {.size = sizeof batch};
  arrays[0] = uv;
  arrays[1] = color;
  batch.arrays = arrays;
  batch.array_count = 2;
  batch.count = points;
  status = nacre_run(binding, NACRE_OUTPUTS, NULL, &batch) == NACRE_OK ? 0 : 1;
  for (i = 0; status == 0 && i < points; ++i) {
    printf("(%.3f, %.3f): %.4f %.4f %.4f\n", uv[i][0], uv[i][1], color[i][0], color[i][1],
           color[i][2]);
  }

end:
  nacre_binding_destroy(binding);
  nacre_binder_destroy(binder);
  nacre_shader_destroy(shader);
  nacre_document_destroy(document);
  nacre_system_destroy(system);
  nacre_report_destroy(report);
  return status;
}
