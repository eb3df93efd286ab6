/* A library with the functions of Open Image Denoise 2 that the host calls. It "denoises" by a
 * formula that shows what it was given: half of the colour, plus albedo, plus ten times the normal,
 * the columns the other way round. Where the first colour is negative it fails.
 */
#include <stddef.h>
#include <string.h>

typedef struct {
  const char* data;
  size_t width, height, offset, pixel, row;
} image;
static image images[4]; /* color, albedo, normal, output */
static int threads, is_hdr, is_committed;
static const char* problem;

static size_t which(const char* name) {
  static const char* const names[] = {"color", "albedo", "normal", "output"};
  size_t i;
  for (i = 0; i < 3; ++i) {
    if (strcmp(name, names[i]) == 0) return i;
  }
  return 3;
}

static float* at(size_t i, size_t x, size_t y) {
  const image* from = &images[i];
  return (float*)(from->data + from->offset + y * from->row + x * from->pixel);
}

void* oidnNewDevice(int type) { return type == 1 ? &threads : NULL; }
void oidnSetDeviceInt(void* device, const char* name, int value) {
  if (strcmp(name, "numThreads") == 0) *(int*)device = value;
}
int oidnGetDeviceInt(void* device, const char* name) {
  return device == &threads && strcmp(name, "version") == 0 ? 20304 : 0;
}
void oidnCommitDevice(void* device) { (void)device; }
int oidnGetDeviceError(void* device, const char** message) {
  const int found = problem != NULL;
  (void)device;
  *message = problem;
  problem = NULL;
  return found;
}
void oidnReleaseDevice(void* device) { (void)device; }
void* oidnNewFilter(void* device, const char* type) {
  (void)device;
  memset(images, 0, sizeof images);
  is_hdr = is_committed = 0;
  return strcmp(type, "RT") == 0 ? images : NULL;
}
void oidnSetSharedFilterImage(void* filter, const char* name, void* pixels, int format,
                              size_t width, size_t height, size_t offset, size_t pixel,
                              size_t row) {
  const image given = {pixels, width, height, offset, pixel, row};
  (void)filter;
  if (format != 3) problem = "not three floats";
  images[which(name)] = given;
}
void oidnSetFilterBool(void* filter, const char* name, _Bool value) {
  (void)filter;
  if (strcmp(name, "hdr") == 0) is_hdr = value;
}
void oidnCommitFilter(void* filter) {
  (void)filter;
  is_committed = 1;
}
void oidnExecuteFilter(void* filter) {
  size_t x, y, c;
  (void)filter;
  if (!is_hdr || !is_committed) problem = "not ready";
  if (at(0, 0, 0)[0] < 0) problem = "made to fail";
  for (y = 0; y < images[0].height; ++y) {
    for (x = 0; x < images[0].width; ++x) {
      for (c = 0; c < 3; ++c) {
        const size_t from = images[0].width - 1 - x;
        float sum = 0.5f * at(0, from, y)[c];
        if (images[1].data != NULL) sum += at(1, from, y)[c];
        if (images[2].data != NULL) sum += 10 * at(2, from, y)[c];
        at(3, x, y)[c] = sum;
      }
    }
  }
}
void oidnReleaseFilter(void* filter) { (void)filter; }
