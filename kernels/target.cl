// What functions are compiled for.
//
// PoCL compiles for the newest processor that its LLVM knows. Where the host has an instruction that counts bits in
// vectors and says so (RPF_AVX512), functions can be compiled for it.
#ifdef RPF_AVX512
#define RPF_TARGET __attribute__((target("avx512vpopcntdq,avx512f,avx512bw,avx512cd,avx512dq,avx512vl,popcnt")))
#else
#define RPF_TARGET
#endif
