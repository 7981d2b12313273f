/* The library from C: filter_frame INPUT.exr OUTPUT.exr [FRACTION]
 * Reads samples, or with "-" writes its own into the buffer; stops when FRACTION of the work is done. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rpf/rpf_c.h"

enum { width = 96, height = 64, samples = 4, slots = 7 };

static float draw(uint32_t* state) { return (float)((*state = *state * 1664525U + 1013904223U) >> 8) / 16777216.0F; }

/* The place of a renderer: writes each record where the filter will work on it. */
static void render(float* record) {
  uint32_t state = 1;
  for (int i = 0; i < width * height * samples; ++i, record += slots) {
    const int pixel = i / samples;
    record[3] = (float)(pixel % width) + draw(&state), record[4] = (float)(pixel / width) + draw(&state);
    record[5] = draw(&state), record[6] = draw(&state);
    record[0] = record[1] = record[2] = record[3] + 24 * (record[5] - 0.5F) > width / 2 ? 0.9F : 0.1F;
  }
}

static rpf_status own_samples(rpf_sample_buffer** buffer) {
  static const char* const names[slots] = {"R", "G", "B", "film.X", "film.Y", "random.lens.U", "random.lens.V"};
  static uint32_t counts[width * height];
  for (int pixel = 0; pixel < width * height; ++pixel) counts[pixel] = samples;
  const rpf_status status = rpf_sample_buffer_new(0, 0, width, height, names, slots, counts, buffer);
  if (status == RPF_OK) render(rpf_sample_buffer_values(*buffer));
  return status;
}

static int show(double fraction, double seconds_left, void* user) {
  (void)seconds_left;
  fprintf(stderr, "%.0f %%\n", 100 * fraction);
  return fraction < *(const double*)user; /* 0 stops */
}

int main(int argc, char** argv) {
  if (argc < 3) return RPF_USAGE;
  double until = argc > 3 ? atof(argv[3]) : 2;
  rpf_settings* settings = NULL;
  rpf_sample_buffer* buffer = NULL;
  rpf_image* image = NULL;
  rpf_status status = rpf_settings_new("balanced", &settings);
  if (status == RPF_OK) status = rpf_settings_set(settings, "threads", "2");
  if (status == RPF_OK)
    status = strcmp(argv[1], "-") == 0 ? own_samples(&buffer) : rpf_sample_buffer_read(argv[1], settings, &buffer);
  if (status == RPF_OK) status = rpf_filter(&buffer, settings, show, &until, &image, NULL);
  if (status == RPF_OK) status = rpf_image_write(argv[2], image);
  if (status != RPF_OK) fprintf(stderr, "%s\n", rpf_error_text());
  rpf_image_free(image);
  rpf_sample_buffer_free(buffer);
  rpf_settings_free(settings);
  return status;
}
