// A renderer that writes its samples: a ball on a checkered floor, out of focus. Usage: renderer OUTPUT.rpf
#include "rpf_samples.h"

#include <math.h>

enum { width = 96, height = 64, samples = 8, channel_count = 14 };
// clang-format off
static const char* const channels[channel_count] = {
    "R", "G", "B", "film.X", "film.Y", "random.lens.U", "random.lens.V", "feature.hit",
    "feature.N.X", "feature.N.Y", "feature.N.Z", "feature.albedo.R", "feature.albedo.G", "feature.albedo.B"};
// clang-format on

static float draw(uint32_t* state) {  // the next random number, in [0,1)
  *state = *state * 747796405U + 2891336453U;
  const uint32_t word = ((*state >> ((*state >> 28) + 4)) ^ *state) * 277803737U;
  return (float)(((word >> 22) ^ word) >> 8) / 16777216.0F;
}

static void render(int x, int y, uint32_t* state, float* record) {
  const float film_x = (float)x + draw(state), film_y = (float)y + draw(state), u = draw(state), v = draw(state);
  const float radius = 0.2F * sqrtf(u), angle = 6.2831853F * v;  // on the lens at (0, 1, -4), sharp at z = 4
  const float o[3] = {radius * cosf(angle), 1 + radius * sinf(angle), -4};
  const float d[3] = {9 * (film_x / width - 0.5F) - o[0], 1 - 6 * (film_y / height - 0.5F) - o[1], 8};
  const float a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], b = o[0] * d[0] + (o[1] - 0.8F) * d[1] + o[2] * d[2];
  const float c = o[0] * o[0] + (o[1] - 0.8F) * (o[1] - 0.8F) + o[2] * o[2] - 0.64F, root = b * b - a * c;
  const float ball = root > 0 ? (-b - sqrtf(root)) / a : -1, ground = -o[1] / d[1], t = ball > 0 ? ball : ground;
  const float p[3] = {o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]};
  const float n[3] = {ball > 0 ? p[0] / 0.8F : 0, ball > 0 ? p[1] / 0.8F - 1 : 1, ball > 0 ? p[2] / 0.8F : 0};
  const float albedo = ball > 0 ? 0.7F : fmodf(floorf(p[0]) + floorf(p[2]), 2) == 0 ? 0.8F : 0.2F;
  const float light = albedo * (0.2F + fmaxf(0, 0.48F * n[0] + 0.64F * n[1] - 0.6F * n[2])), hit = t > 0 && t < 9;
  const float seen[] = {light, light, light, film_x, film_y, u, v, 1, n[0], n[1], n[2], albedo, albedo, albedo};
  const float sky[] = {0.5F, 0.7F, 1, film_x, film_y, u, v, 0, NAN, NAN, NAN, NAN, NAN, NAN};
  memcpy(record, hit > 0 ? seen : sky, sizeof seen);
}

int main(int argc, char** argv) {
  rpf_samples* file = rpf_samples_open(argc > 1 ? argv[1] : "ball.rpf", 0, 0, width, height, channels, channel_count);
  rpf_samples_text(file, "rpf:renderer", "renderer of 40 lines");
  for (int y = 0; y < height; ++y)  // threads may share them out as they like
    for (int x = 0; x < width; ++x) {
      float records[samples][channel_count];
      uint32_t state = (uint32_t)(y * width + x) * 2654435769U;
      for (int s = 0; s < samples; ++s) render(x, y, &state, records[s]);
      rpf_samples_add(file, x, y, samples, records[0]);
    }
  const int status = rpf_samples_finish(file);
  if (status != RPF_SAMPLES_OK) fprintf(stderr, "%s\n", rpf_samples_error(file));
  rpf_samples_free(file);
  return status;
}
