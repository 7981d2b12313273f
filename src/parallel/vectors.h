// Loops that are compiled for AVX2 and fused multiply-add too, and run so where the processor has them: they take wider
// vectors, and fma() is no call of the C library. The same bits either way.
#pragma once

namespace rpf {

template <typename Work>
#if defined(__x86_64__)
__attribute__((target("avx2,fma"), flatten))
#endif
inline void
call_with_avx2(const Work& work) {
  work();
}

/// Calls work(), compiled into this call as a whole.
template <typename Work>
void with_avx2(const Work& work) {
#if defined(__x86_64__)
  static const bool is_there = __builtin_cpu_supports("fma") > 0 && __builtin_cpu_supports("avx2") > 0;
  if (is_there) return call_with_avx2(work);
#endif
  work();
}

}  // namespace rpf
