/* Does what is asked, one step after another, and says after each which of the libraries that are
 * loaded on demand are there.
 *
 *   host [colors CONFIG] [outputs DOCUMENT OUTPUT]...
 */
#include <nacre/nacre.h>
#include <stdio.h>
#include <string.h>

static int fail(const nacre_report* report) {
  size_t i;
  for (i = 0; i < nacre_report_count(report); ++i) {
    nacre_diagnostic said = {.size = sizeof said};
    if (nacre_report_get(report, i, &said) == NACRE_OK) fprintf(stderr, "%s\n", said.text);
  }
  return 1;
}

/* "step: PATH PATH\n", of libraries whose first pages are mapped. */
static void say(const char* step) {
  static const char* const names[] = {"libOpenImageIO.so", "libOpenEXR-", "libOpenColorIO.so",
                                      "nacre_images.so", "nacre_colors.so"};
  char line[4096];
  size_t i;
  FILE* maps = fopen("/proc/self/maps", "r");
  printf("%s:", step);
  while (maps != NULL && fgets(line, sizeof line, maps) != NULL) {
    const char* path = strchr(line, '/');
    if (path == NULL || strstr(line, " 00000000 ") == NULL) continue;
    for (i = 0; i < sizeof names / sizeof names[0]; ++i) {
      if (strstr(path, names[i]) != NULL) printf(" %.*s", (int)strcspn(path, "\n"), path);
    }
  }
  if (maps != NULL) fclose(maps);
  printf("\n");
  fflush(stdout);
}

static int compile(nacre_system* system, const char* file, const char* output,
                   nacre_report* report) {
  nacre_document* document = NULL;
  nacre_shader* shader = NULL;
  const char* const outputs[1] = {output};
  const int good =
      nacre_document_read(file, NULL, report, &document) == NACRE_OK &&
      nacre_compile_outputs(system, document, outputs, 1, NULL, report, &shader) == NACRE_OK;
  nacre_shader_destroy(shader);
  nacre_document_destroy(document);
  return good;
}

int main(int argc, char** argv) {
  nacre_report* report = NULL;
  nacre_system* system = NULL;
  nacre_system_options options = {.size = sizeof options};
  int i = 1, status = 0;

  say(nacre_version_text());
  if (nacre_report_create(&report) != NACRE_OK) return 1;
  if (i + 1 < argc && strcmp(argv[i], "colors") == 0) {
    options.ocio_config = argv[i + 1];
    i += 2;
  }
  if (nacre_system_create(&options, report, &system) != NACRE_OK) status = fail(report);
  say("system");
  for (; status == 0 && i + 2 < argc && strcmp(argv[i], "outputs") == 0; i += 3) {
    if (!compile(system, argv[i + 1], argv[i + 2], report)) status = fail(report);
    say(argv[i + 2]);
  }
  if (status == 0 && i != argc) status = 2;
  nacre_system_destroy(system);
  nacre_report_destroy(report);
  return status;
}
