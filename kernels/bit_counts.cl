// How many bits of planes are set. Words are counted one after another, up to RPF_WORDS_AT_ONCE of them into one sum of
// bits_of(), of which total_of() makes the numbers. (OpenCL's popcount is compiled to one scalar after the other, or to
// vectors of half the size.)

#if defined(RPF_AVX512)

#define RPF_WORDS_AT_ONCE (~(size_t)0)
static ulong8 bits_of(ulong8 words) { return as_ulong8(__builtin_ia32_vpopcntq_512(as_long8(words))); }
static ulong8 total_of(ulong8 sum) { return sum; }

#elif defined(RPF_AVX2)

#define RPF_WORDS_AT_ONCE ((size_t)31)  // 8 bits each in sums of bytes

typedef char Bytes __attribute__((ext_vector_type(32)));

// Of every byte: the halves of bytes are looked up in a table of 16.
static ulong4 bits_of_bytes(ulong4 words) {
  const ulong2 table = {0x0302020102010100ul, 0x0403030203020201ul};
  const Bytes bits = __builtin_astype((ulong4)(table, table), Bytes);
  const ulong4 nibbles = 0x0f0f0f0f0f0f0f0ful;
  const Bytes low = __builtin_ia32_pshufb256(bits, __builtin_astype(words & nibbles, Bytes)),
              high = __builtin_ia32_pshufb256(bits, __builtin_astype((words >> 4) & nibbles, Bytes));
  return __builtin_astype((Bytes)(low + high), ulong4);
}

static ulong4 total_of_bytes(ulong4 sum) {
  return __builtin_astype(__builtin_ia32_psadbw256(__builtin_astype(sum, Bytes), (Bytes)(0)), ulong4);
}

static ulong8 bits_of(ulong8 words) { return (ulong8)(bits_of_bytes(words.lo), bits_of_bytes(words.hi)); }
static ulong8 total_of(ulong8 sum) { return (ulong8)(total_of_bytes(sum.lo), total_of_bytes(sum.hi)); }

#else

#define RPF_WORDS_AT_ONCE (~(size_t)0)
static ulong8 bits_of(ulong8 words) { return popcount(words); }
static ulong8 total_of(ulong8 sum) { return sum; }

#endif

// The end of the words from `first` on that are counted into one sum.
static size_t end_of_words(size_t first, size_t words) {
  return words - first < RPF_WORDS_AT_ONCE ? words : first + RPF_WORDS_AT_ONCE;
}
