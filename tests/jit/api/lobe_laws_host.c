/* <nacre/lobe_test.h> for a host in C: it writes a white diffuse lobe, wrong in a way that is
 * named, and says which laws do not hold.
 *
 *   lobe_laws_host FOLDER [gains|claims_less|density|lean|late]
 *
 * Prints the laws, each once, in the order that they were found in, and the energy of the first
 * view.
 */
#include <nacre/lobe_test.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265f

typedef struct {
  const char* wrong;
} planted;

static int is_wrong(const void* user, const char* how) {
  return strcmp(((const planted*)user)->wrong, how) == 0;
}

static nacre_value number(float value) { return nacre_literal_float(value); }
static nacre_value record(nacre_operation operation, nacre_value a, nacre_value b) {
  const nacre_value operands[2] = {a, b};
  return nacre_record(operation, operands, 2, 0);
}
static nacre_value times(nacre_value a, nacre_value b) { return record(NACRE_MUL, a, b); }
static nacre_value of(nacre_operation operation, nacre_value a) {
  return nacre_record(operation, &a, 1, 0);
}

static void evaluate(void* user, const nacre_view* view, const nacre_value wi[3], nacre_value f[3],
                     nacre_value* pdf) {
  const nacre_value right = times(record(NACRE_MAX, wi[2], number(0)), number(1 / PI));
  int i;
  (void)view;
  for (i = 0; i < 3; ++i) f[i] = times(right, number(is_wrong(user, "gains") ? 1.05f : 1.0f));
  *pdf = times(right, number(is_wrong(user, "density") ? 1.1f : 1.0f));
}

/* Malley's method. */
static void sample(void* user, const nacre_view* view, const nacre_value u[3],
                   nacre_lobe_sample* result) {
  const nacre_value radius = of(NACRE_SQRT, u[0]);
  const nacre_value angle = times(u[1], number(2 * PI));
  const nacre_value height =
      of(NACRE_SQRT, record(NACRE_MAX, record(NACRE_SUB, number(1), u[0]), number(0)));
  (void)view;
  result->wi[0] = times(radius, of(NACRE_COS, angle));
  result->wi[1] = times(radius, of(NACRE_SIN, angle));
  result->wi[2] = height;
  result->valid = nacre_literal_bool(1);
  if (is_wrong(user, "late")) result->wi[2] = times(height, number(1.1f));
  if (is_wrong(user, "lean")) { /* More towards x than the density says. */
    const nacre_value turned = of(NACRE_ABS, result->wi[0]);
    const nacre_value some = record(NACRE_LT, u[2], number(0.1f));
    const nacre_value choice[3] = {some, turned, result->wi[0]};
    result->wi[0] = nacre_record(NACRE_SELECT, choice, 3, 0);
  }
}

static void albedo(void* user, const nacre_view* view, nacre_value rgb[3]) {
  (void)view;
  rgb[0] = rgb[1] = rgb[2] = number(is_wrong(user, "claims_less") ? 0.95f : 1.0f);
}

static void body(void* user, nacre_node* node) {
  nacre_lobe lobe = {.size = sizeof lobe};
  lobe.name = "planted";
  lobe.kinds = NACRE_DIFFUSE_REFLECTION;
  lobe.user = user;
  lobe.evaluate = evaluate;
  lobe.sample = sample;
  lobe.albedo = albedo;
  nacre_node_set_lobe(node, &lobe);
}

static const char pack[] =
    "<materialx version='1.39'><nodedef name='ND_planted' node='planted'>"
    "<input name='weight' type='float' value='1'/><output name='out' "
    "type='BSDF'/></nodedef></materialx>";
static const char document[] =
    "<materialx version='1.39'><planted name='b' type='BSDF'/><surface name='S' "
    "type='surfaceshader'>"
    "<input name='bsdf' type='BSDF' nodename='b'/></surface><surfacematerial name='M' "
    "type='material'>"
    "<input name='surfaceshader' type='surfaceshader' nodename='S'/></surfacematerial></materialx>";

static int write_pack(const char* file) {
  FILE* out = fopen(file, "w");
  const int good = out != NULL && fwrite(pack, sizeof pack - 1, 1, out) == 1;
  return (out == NULL || fclose(out) == 0) && good;
}

static void print(const nacre_lobe_report* found) {
  nacre_lobe_view view = {.size = sizeof view};
  size_t i, k;
  for (i = 0; i < nacre_lobe_report_fault_count(found); ++i) {
    nacre_lobe_fault fault = {.size = sizeof fault}, before = {.size = sizeof before};
    int is_known = 0;
    nacre_lobe_report_fault(found, i, &fault);
    for (k = 0; k < i; ++k) {
      nacre_lobe_report_fault(found, k, &before);
      is_known = is_known || strcmp(before.law, fault.law) == 0;
    }
    if (!is_known) printf("%s ", fault.law);
  }
  if (nacre_lobe_report_view(found, 0, &view) == NACRE_OK) {
    printf("| %zu views, energy %.2f\n", nacre_lobe_report_view_count(found), view.energy[0]);
  }
}

int main(int argc, char** argv) {
  planted lobe = {.wrong = argc > 2 ? argv[2] : ""};
  const nacre_body bodies[1] = {
      {.size = sizeof(nacre_body), .nodedef = "ND_planted", .user = &lobe, .record = body}};
  const float straight[1][3] = {{0, 0, 1}};
  nacre_system_options options = {.size = sizeof options};
  nacre_lobe_test_options asked = {.size = sizeof asked};
  nacre_system* system = NULL;
  nacre_document* read = NULL;
  nacre_shader* shader = NULL;
  nacre_report* report = NULL;
  nacre_lobe_report* found = NULL;
  char file[4096];
  const char* libraries[2];
  int status;
  size_t i;

  if (argc < 2) return 2;
  snprintf(file, sizeof file, "%s/lobe_laws_%s.mtlx", argv[1], lobe.wrong);
  if (!write_pack(file)) return 2;
  libraries[0] = nacre_data_library();
  libraries[1] = file;
  options.libraries = libraries;
  options.library_count = 2;
  options.bodies = bodies;
  options.body_count = 1;
  if (nacre_report_create(&report) != NACRE_OK) return 2;
  if (strcmp(lobe.wrong, "lean") == 0) {
    asked.wo = straight;
    asked.wo_count = 1;
  }
  status =
      nacre_system_create(&options, report, &system) == NACRE_OK &&
      nacre_document_parse(document, sizeof document - 1, NULL, NULL, report, &read) == NACRE_OK &&
      nacre_compile_material(system, read, "M", NULL, report, &shader) == NACRE_OK &&
      nacre_test_lobes(shader, &asked, report, &found) == NACRE_OK;
  for (i = 0; i < nacre_report_count(report); ++i) {
    nacre_diagnostic said = {.size = sizeof said};
    if (nacre_report_get(report, i, &said) == NACRE_OK) fprintf(stderr, "%s\n", said.text);
  }
  if (status) print(found);
  nacre_lobe_report_destroy(found);
  nacre_shader_destroy(shader);
  nacre_document_destroy(read);
  nacre_system_destroy(system);
  nacre_report_destroy(report);
  return status ? 0 : 1;
}
