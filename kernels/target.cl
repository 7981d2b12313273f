// What functions are compiled for.
//
// The host says where PoCL compiles for a processor that has AVX2 (RPF_AVX2), also where it has more. PoCL compiles for
// the newest processor that its LLVM knows; where the host has an instruction that counts bits in vectors and says so
// (RPF_AVX512, never without the other), functions can be compiled for it.
#ifdef RPF_AVX512
#define RPF_TARGET __attribute__((target("avx512vpopcntdq,avx512f,avx512bw,avx512cd,avx512dq,avx512vl,popcnt")))
#else
#define RPF_TARGET
#endif
