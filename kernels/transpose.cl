// Rows and columns of 16 vectors, in registers.

static float16 interleave(float8 even, float8 odd) {
  float16 both;
  both.even = even;
  both.odd = odd;
  return both;
}

// 16 rows become 16 columns: each of four rounds interleaves row i with row i + 8, which rotates the bits of an
// element's place (row, column) by one.
__attribute__((always_inline)) static void transpose(float16* rows) {
#pragma unroll
  for (int round = 0; round < 4; ++round) {
    float16 mixed[RPF_LANES];
#pragma unroll
    for (int i = 0; i < RPF_LANES / 2; ++i) {
      mixed[2 * i] = interleave(rows[i].lo, rows[i + 8].lo);
      mixed[2 * i + 1] = interleave(rows[i].hi, rows[i + 8].hi);
    }
#pragma unroll
    for (int i = 0; i < RPF_LANES; ++i) rows[i] = mixed[i];
  }
}
