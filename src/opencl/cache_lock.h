// Processes that share a folder of compiled kernels: one compiles, the others wait for what it leaves.
#pragma once

#include <chrono>
#include <string>

#include "opencl/child.h"

namespace rpf {

/// Held by one process at a time for each name; free when that process ends, however it does. Others wait, and call
/// `check` meanwhile, which may throw; after `limit` they go on, as where the file system has no locks: two that
/// compile the same at once do twice the work, and may take each other's half written files for damaged.
class CacheLock {
 public:
  CacheLock(const std::string& name, std::chrono::seconds limit, const Check& check);
  CacheLock(const CacheLock&) = delete;
  CacheLock& operator=(const CacheLock&) = delete;
  ~CacheLock();

 private:
  explicit CacheLock(const std::string& name);

  int descriptor_ = -1;
};

}  // namespace rpf
