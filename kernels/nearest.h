// The space that samples of a film, a lens and a time lie in (algorithm.md, section 12): which of them is nearest to a
// point in a pixel's column, in the metric of the leaf that the point lies in.
#ifndef RPF_NEAREST_H
#define RPF_NEAREST_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "view_sums.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

#define RPF_DIMENSIONS 5    // x, y, u, v, t
#define RPF_METRIC 20       // floats a leaf: the metric's upper triangle 15, all but the diagonal twice; reach 5
#define RPF_REACH 15        // where those begin: the least squared distance to what is 1 away along a dimension
#define RPF_MOST_LEAVES 64  // that a search looks into
#define RPF_DEEPEST 32      // levels of a tree

typedef struct {
  int width, height;  // pixels
  uint carried, leaves;
} rpf_columns;

// A point of every pixel's column: from the pixel's corner on.
typedef struct {
  float at[RPF_DIMENSIONS];
} rpf_point;

// Nodes 1 .. leaves - 1, children of n are 2 n and 2 n + 1, from `leaves` on they are leaves: first[leaf] .. first[leaf
// + 1] of places and samples.
typedef struct {
  const RPF_SHARED uint* axis;
  const RPF_SHARED float* split;
  const RPF_SHARED uint* first;
  const RPF_SHARED float* place;
  const RPF_SHARED uint* sample;
  const RPF_SHARED float* metric;
} rpf_sample_tree;

// A part of the tree that is yet to be looked into, and how near what it holds may be.
typedef struct {
  uint node;
  float distance;
} rpf_branch;

typedef struct {
  uint sample;
  float distance;  // squared
} rpf_found;

// (12.5): the squared distance.
RPF_INLINE float rpf_apart(const RPF_SHARED float* metric, const RPF_SHARED float* place, const float* at) {
  float off[RPF_DIMENSIONS], sum = 0.0f;
  for (int k = 0; k < RPF_DIMENSIONS; ++k) off[k] = place[k] - at[k];
  int next = 0;
  for (int i = 0; i < RPF_DIMENSIONS; ++i) {
    float row = 0.0f;
    for (int j = i; j < RPF_DIMENSIONS; ++j) row = rpf_added(row, metric[next++] * off[j]);
    sum = rpf_added(sum, off[i] * row);
  }
  return sum;
}

RPF_INLINE uint rpf_leaf_of(const rpf_sample_tree* tree, uint leaves, const float* at) {
  uint node = 1;
  while (node < leaves) node = 2 * node + (at[tree->axis[node]] >= tree->split[node]);
  return node - leaves;
}

RPF_INLINE void rpf_look_into(const rpf_sample_tree* tree, uint leaf, const RPF_SHARED float* metric, const float* at,
                              rpf_found* best) {
  for (uint i = tree->first[leaf]; i < tree->first[leaf + 1]; ++i) {
    const uint sample = tree->sample[i];
    const float distance = rpf_apart(metric, tree->place + RPF_DIMENSIONS * (size_t)i, at);
    const int is_nearer = distance < best->distance || (distance == best->distance && sample < best->sample);
    if (best->sample != RPF_NOBODY && !is_nearer) continue;
    best->sample = sample;
    best->distance = distance;
  }
}

// Goes down to a leaf on the point's side; the other sides wait.
RPF_INLINE uint rpf_go_down(const rpf_sample_tree* tree, uint leaves, const RPF_SHARED float* metric, const float* at,
                            rpf_branch from, rpf_branch* waiting, uint* count) {
  while (from.node < leaves) {
    const uint axis = tree->axis[from.node];
    const float off = at[axis] - tree->split[from.node], across = off * off * metric[RPF_REACH + axis];
    const uint side = off >= 0.0f;
    waiting[*count].node = 2 * from.node + 1 - side;
    waiting[*count].distance = across > from.distance ? across : from.distance;
    ++*count;
    from.node = 2 * from.node + side;
  }
  return from.node - leaves;
}

// The sample that is nearest to a point, of those in the leaves that the search gets to.
RPF_INLINE uint rpf_nearest(const rpf_sample_tree* tree, uint leaves, const float* at) {
  const RPF_SHARED float* metric = tree->metric + RPF_METRIC * (size_t)rpf_leaf_of(tree, leaves, at);
  rpf_branch waiting[RPF_DEEPEST], from = {1, 0.0f};
  rpf_found best = {RPF_NOBODY, 0.0f};
  uint count = 0;
  for (int looked = 0; looked < RPF_MOST_LEAVES; ++looked) {
    rpf_look_into(tree, rpf_go_down(tree, leaves, metric, at, from, waiting, &count), metric, at, &best);
    do {
      if (count == 0) return best.sample;
      from = waiting[--count];
    } while (from.distance > best.distance);
  }
  return best.sample;
}

// Pixels x0 .. x1 - 1 of row y take the sample that is nearest to the point in their columns.
RPF_INLINE void rpf_integrate_run(const rpf_columns* columns, const rpf_point* point, const rpf_sample_tree* tree,
                                  const rpf_view_sums* sums, int y, int x0, int x1) {
  for (int x = x0; x < x1; ++x) {
    rpf_point there = *point;
    there.at[0] += (float)x;
    there.at[1] += (float)y;
    rpf_add_view(sums, (size_t)y * (size_t)columns->width + (size_t)x, rpf_nearest(tree, columns->leaves, there.at));
  }
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
