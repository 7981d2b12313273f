// Samples seen again from another place of the lens at another time (algorithm.md, section 11): where each stands then,
// which of those around a place of the film are one surface, and which of the surfaces is seen there.
#ifndef RPF_VIEWS_H
#define RPF_VIEWS_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "view_sums.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

#define RPF_TRACK 10  // floats a sample: start 3, travel 3, bend 3 of (11.1), 1 where the ray left the scene
#define RPF_ENDS 6    // floats a sample: x, y, shift shortly before the view, and after it
#define RPF_PLACE 3   // floats a sample: x, y, depth in a view
#define RPF_MOST_SEEN 32
#define RPF_LEAST_NEARNESS 1e-6f
#define RPF_CLOSE_BY 0.0883883476f  // 1 / sqrt(128): (11.4) looks so far around a view, radii; in time half of it
#define RPF_FARTHEST 3e38f          // depth of what a ray saw that left the scene

// The camera. A row of four is what stands before a position's coordinates, and 1.
typedef struct {
  float film[3][4];       // x and y in pixels times the third
  float depth[4];         // along the axis, scene units
  float right[2], up[2];  // how far the edge of the lens moves what has a shift of 1, pixels
  float inverse_focus;    // 1 / scene units
} rpf_lens;

// What is asked for: the light through u, v of the lens, in radii, at a time, at x, y in each pixel.
typedef struct {
  float u, v, time, x, y;
} rpf_view;

// Cells are squares that the film is cut into, `finer` a pixel, with `margin` more around it.
typedef struct {
  int width, height;  // pixels
  int finer, margin;
  float reach;  // radius of the largest empty circle, pixels
  uint carried;
  rpf_lens lens;
} rpf_light_field;

typedef struct {
  float x, y, depth, shift;
} rpf_sighting;

// A sample near the place that is looked at, which x and y start from.
typedef struct {
  float distance, x, y, depth;  // distance: squared
  uint sample;
} rpf_near;

// Those around a place: nearest first, later front to back.
typedef struct {
  uint count;
  rpf_near near[RPF_MOST_SEEN];
} rpf_seen;

// Of those, front to back, first .. end - 1.
typedef struct {
  uint first, end;
} rpf_surface;

// What a view was sorted into. Samples of a cell follow each other, cells row by row: first[cell] .. first[cell + 1].
typedef struct {
  const RPF_SHARED uint* first;
  const RPF_SHARED float* place;
  const RPF_SHARED uint* sample;
} rpf_cells;

RPF_INLINE float rpf_affine(const float* row, const float* p) {
  return row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
}

RPF_INLINE int rpf_floor(float x) {
  const int whole = (int)x;
  return whole - ((float)whole > x);
}

// (11.1) and (11.2).
RPF_INLINE rpf_sighting rpf_sight(const RPF_SHARED float* track, const rpf_lens* lens, float u, float v, float time) {
  rpf_sighting seen;
  if (track[9] > 0.0f) {
    seen.x = track[0];
    seen.y = track[1];
    seen.depth = RPF_FARTHEST;
    seen.shift = -lens->inverse_focus;
    return seen;
  }
  float p[3];
  for (int k = 0; k < 3; ++k) p[k] = track[k] + time * track[3 + k] + time * (time - 1.0f) * track[6 + k];
  const float along = rpf_affine(lens->film[2], p);
  seen.depth = rpf_affine(lens->depth, p);
  seen.shift = 1.0f / seen.depth - lens->inverse_focus;
  seen.x = rpf_affine(lens->film[0], p) / along - (u * lens->right[0] + v * lens->up[0]) * seen.shift;
  seen.y = rpf_affine(lens->film[1], p) / along - (u * lens->right[1] + v * lens->up[1]) * seen.shift;
  return seen;
}

// Where a sample stands in a view, and where shortly before and after it.
RPF_INLINE void rpf_move(const RPF_SHARED float* track, const rpf_lens* lens, const rpf_view* view,
                         RPF_SHARED float* place, RPF_SHARED float* ends) {
  const rpf_sighting seen = rpf_sight(track, lens, view->u, view->v, view->time);
  place[0] = seen.x;
  place[1] = seen.y;
  place[2] = seen.depth;
  for (int end = 0; end < 2; ++end) {
    const float time = view->time + ((float)end - 0.5f) * RPF_CLOSE_BY;
    const rpf_sighting then = rpf_sight(track, lens, view->u, view->v, time);
    ends[3 * end] = then.x;
    ends[3 * end + 1] = then.y;
    ends[3 * end + 2] = then.shift;
  }
}

RPF_INLINE int rpf_is_nearer(const rpf_near* a, const rpf_near* b) {
  return a->distance < b->distance || (a->distance == b->distance && a->sample < b->sample);
}

RPF_INLINE int rpf_is_before(const rpf_near* a, const rpf_near* b) {
  return a->depth < b->depth || (a->depth == b->depth && a->sample < b->sample);
}

// Keeps the nearest RPF_MOST_SEEN.
RPF_INLINE void rpf_notice(rpf_seen* seen, const rpf_near* found) {
  uint i = seen->count;
  if (i < RPF_MOST_SEEN)
    ++seen->count;
  else if (!rpf_is_nearer(found, &seen->near[--i]))
    return;
  for (; i > 0 && rpf_is_nearer(found, &seen->near[i - 1]); --i) seen->near[i] = seen->near[i - 1];
  seen->near[i] = *found;
}

RPF_INLINE void rpf_sort_by_depth(rpf_seen* seen) {
  for (uint n = 1; n < seen->count; ++n) {
    const rpf_near moved = seen->near[n];
    uint i = n;
    for (; i > 0 && rpf_is_before(&moved, &seen->near[i - 1]); --i) seen->near[i] = seen->near[i - 1];
    seen->near[i] = moved;
  }
}

// How many cells of a view lie beside and below each other, its margins among them.
RPF_INLINE int rpf_cell_columns(const rpf_light_field* field) {
  return field->width * field->finer + 2 * field->margin;
}
RPF_INLINE int rpf_cell_rows(const rpf_light_field* field) { return field->height * field->finer + 2 * field->margin; }

// Those within the reach of x, y.
RPF_INLINE void rpf_look_around(const rpf_light_field* field, const rpf_cells* cells, float x, float y,
                                rpf_seen* seen) {
  const float reach = field->reach, finer = (float)field->finer;
  const int columns = rpf_cell_columns(field);
  const int left = rpf_floor((x - reach) * finer) + field->margin,
            right = rpf_floor((x + reach) * finer) + field->margin;
  const int top = rpf_floor((y - reach) * finer) + field->margin,
            bottom = rpf_floor((y + reach) * finer) + field->margin;
  seen->count = 0;
  for (int row = top; row <= bottom; ++row) {
    const size_t cell = (size_t)row * (size_t)columns;
    const uint end = cells->first[cell + (size_t)right + 1];
    for (uint i = cells->first[cell + (size_t)left]; i < end; ++i) {
      const RPF_SHARED float* place = cells->place + RPF_PLACE * (size_t)i;
      const float dx = place[0] - x, dy = place[1] - y, distance = dx * dx + dy * dy;
      if (distance > reach * reach) continue;
      const rpf_near found = {distance, dx, dy, place[2], cells->sample[i]};
      rpf_notice(seen, &found);
    }
  }
}

// (11.4): whether one passes the other close by the view, on the lens and in time.
RPF_INLINE int rpf_crosses(const rpf_lens* lens, const RPF_SHARED float* ends, const rpf_near* a, const rpf_near* b) {
  const float x = b->x - a->x, y = b->y - a->y;
  const float across = lens->right[0] * x + lens->right[1] * y, along = lens->up[0] * x + lens->up[1] * y;
  const float most = RPF_CLOSE_BY * sqrt(across * across + along * along);
  const RPF_SHARED float* from = ends + RPF_ENDS * (size_t)a->sample;
  const RPF_SHARED float* to = ends + RPF_ENDS * (size_t)b->sample;
  for (int end = 0; end < RPF_ENDS; end += 3) {
    const float still = (to[end] - from[end]) * x + (to[end + 1] - from[end + 1]) * y;
    if (still < fabs(to[end + 2] - from[end + 2]) * most) return 1;
  }
  return 0;
}

// (11.5): whether three of the samples first .. end - 1 are corners of a triangle that holds the place: they are not
// all to one side of any of them.
RPF_INLINE int rpf_covers(const rpf_seen* seen, uint first, uint end) {
  for (uint i = first; i < end; ++i) {
    int is_inside = 0;
    for (uint j = first; j < end && !is_inside; ++j)
      is_inside = seen->near[i].x * seen->near[j].y - seen->near[i].y * seen->near[j].x < 0.0f;
    if (!is_inside) return 0;
  }
  return end - first > 2;
}

// The surface that is seen at x, y of the film, and what is around; empty where nothing is.
RPF_INLINE rpf_surface rpf_see(const rpf_light_field* field, const rpf_cells* cells, const RPF_SHARED float* ends,
                               float x, float y, rpf_seen* seen) {
  rpf_look_around(field, cells, x, y, seen);
  rpf_sort_by_depth(seen);
  rpf_surface surface = {0, 0};
  for (uint next = 0; next < seen->count; ++next) {
    int is_other = 0;
    for (uint i = surface.first; i < next && !is_other; ++i)
      is_other = rpf_crosses(&field->lens, ends, &seen->near[i], &seen->near[next]);
    if (is_other && rpf_covers(seen, surface.first, next)) break;
    if (is_other) surface.first = next;
    surface.end = next + 1;
  }
  return surface;
}

// (11.6): what each sample of the surface counts, 1 together.
RPF_INLINE void rpf_find_shares(float reach, const rpf_seen* seen, rpf_surface surface, float* share) {
  float sum = 0.0f;
  for (uint i = surface.first; i < surface.end; ++i) {
    const float nearness = 1.0f - sqrt(seen->near[i].distance) / reach;
    share[i] = nearness > RPF_LEAST_NEARNESS ? nearness : RPF_LEAST_NEARNESS;
    sum = rpf_added(sum, share[i]);
  }
  for (uint i = surface.first; i < surface.end; ++i) share[i] /= sum;
}

// What rpf_add_view() does with a sample.
RPF_INLINE void rpf_add_surface(float reach, const rpf_view_sums* s, size_t pixel, const rpf_seen* seen,
                                rpf_surface surface) {
  if (surface.end == 0) return;
  float share[RPF_MOST_SEEN];
  rpf_find_shares(reach, seen, surface, share);
  for (uint c = 0; c < s->carried; ++c) {
    const float mean = s->means[c * s->pixels + pixel];
    float off = 0.0f;
    for (uint i = surface.first; i < surface.end; ++i)
      off = rpf_added(off, share[i] * (s->colors[(size_t)seen->near[i].sample * s->carried + c] - mean));
    s->sums[c * s->pixels + pixel] += off;
  }
  s->sums[s->carried * s->pixels + pixel] += 1.0f;
}

// Pixels x0 .. x1 - 1 of row y take what they see.
RPF_INLINE void rpf_see_run(const rpf_light_field* field, const rpf_view* view, const rpf_cells* cells,
                            const RPF_SHARED float* ends, const rpf_view_sums* sums, int y, int x0, int x1) {
  rpf_seen seen;
  for (int x = x0; x < x1; ++x) {
    const rpf_surface surface = rpf_see(field, cells, ends, (float)x + view->x, (float)y + view->y, &seen);
    rpf_add_surface(field->reach, sums, (size_t)y * (size_t)field->width + (size_t)x, &seen, surface);
  }
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
