// Section 6: what the own samples of a pixel are filtered with, from the records of its neighborhood (box.cl has its
// own).

// The coordinates of a distance are variables times a scale: colors first, then features.
typedef struct {
  uint own, neighbors;
  uint count;  // of coordinates
  ushort place[RPF_COORDINATES];
  ushort column_of[RPF_CHUNKS * RPF_LANES];  // by place
  float16 scale[RPF_CHUNKS];                 // by place; c' is left as it is
  const Normalization* normalization;
} Means;

static void add_coordinate(uint variable, float scale, float* scales, Means* out) {
  if (!(scale > 0.0f)) return;
  const uint place = place_of(variable);
  out->column_of[place] = (ushort)out->count;
  out->place[out->count] = (ushort)place;
  ++out->count;
  scales[place] = scale;
}

// own, neighbors and normalization of `out` are set.
static void choose_coordinates(const rpf_pass* pass, const rpf_color_weights* color, const float* beta, Means* out) {
  const float sharpness = rpf_sharpness(color->fraction_random, pass->noise, out->own);
  float scales[RPF_CHUNKS * RPF_LANES];
  for (uint place = 0; place < RPF_CHUNKS * RPF_LANES; ++place) {
    const int is_color = place >= RPF_VARIABLES && place < RPF_VARIABLES + RPF_CARRIED;
    out->column_of[place] = (ushort)(is_color ? RPF_FIRST_COLOR + place - RPF_VARIABLES : RPF_COLUMNS - 1);
    scales[place] = 1.0f;
  }
  out->count = 0;
  for (uint i = 0; i < 3; ++i) add_coordinate(i, rpf_distance_scale(sharpness, color->alpha[i]), scales, out);
  for (uint k = 0; k < RPF_FEATURES; ++k)
    add_coordinate(RPF_FIRST_FEATURE + k, rpf_distance_scale(sharpness, beta[k]), scales, out);
  for (int c = 0; c < RPF_CHUNKS; ++c) out->scale[c] = vload16(c, scales);
}

static float16 scaled(const rpf_pass* pass, const Slot* slot, const Means* means, uint j, int chunk) {
  return normalized(pass, slot, j, chunk, means->normalization) * means->scale[chunk];
}

// A stretch of neighbors, from block `first` on, as columns: the scaled coordinates and c'. Behind the last neighbor
// the first one is repeated: it gets no weight, and its color is inside every range.
static void fill_columns(const rpf_pass* pass, const Slot* slot, const Means* means, uint first, uint last) {
  for (uint block = first; block < last; ++block)
#pragma unroll
    for (int c = 0; c < RPF_CHUNKS; ++c) {
      float16 rows[RPF_LANES];
#pragma unroll
      for (uint l = 0; l < RPF_LANES; ++l) {
        const uint j = block * RPF_LANES + l;
        rows[l] = scaled(pass, slot, means, j < means->neighbors ? j : 0, c);
      }
      transpose(rows);
#pragma unroll
      for (int l = 0; l < RPF_LANES; ++l)
        slot->columns[means->column_of[RPF_LANES * c + l] * RPF_STRETCH + block - first] = rows[l];
    }
}

// The scaled coordinates of a batch of own samples. Behind the last own sample that one is repeated.
static void load_own(const rpf_pass* pass, const Slot* slot, const Means* means, uint begin,
                     float (*own)[RPF_COORDINATES]) {
  for (uint i = 0; i < RPF_BATCH; ++i) {
    float values[RPF_CHUNKS * RPF_LANES];
    for (int c = 0; c < RPF_CHUNKS; ++c)
      vstore16(scaled(pass, slot, means, min(begin + i, means->own - 1), c), c, values);
    for (uint a = 0; a < means->count; ++a) own[i][a] = values[means->place[a]];
  }
}
