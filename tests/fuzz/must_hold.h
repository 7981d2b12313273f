// The fuzz targets' assertion.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

/// Stops the run where `claim` is false; the fuzzer then keeps the input.
inline void must_hold(bool claim, const std::string& text) {
  if (claim) return;
  std::fprintf(stderr, "does not hold: %s\n", text.c_str());
  std::abort();
}
