// Work that several threads share. Of our own: a library of threads in this process would be the one that OpenCL
// drivers find in place of the version that they bring along (docs/architecture.md).
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace rpf {

class Workers {
 public:
  /// So many threads, of which the one that calls for_all() is one; at least 1.
  explicit Workers(int threads) : threads_(threads) {}
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers() = default;

  /// `worker`: 0 .. threads - 1, one at a time each: which of the caller's scratch spaces is free.
  using Body = std::function<void(std::size_t index, std::size_t worker)>;

  /// Runs body(first) .. body(end - 1), each once, in any order; where threads cannot be had, on fewer. What a body
  /// throws stops the others, and is thrown here once all have ended.
  void for_all(std::size_t first, std::size_t end, const Body& body);

  /// From any thread, once and for all: for_all() starts no more bodies, and those that run are asked to end.
  void stop() { stop_ = true; }

  std::size_t count() const { return static_cast<std::size_t>(threads_); }

 private:
  int threads_;
  std::atomic<bool> stop_{false};
};

/// Whether the body that runs here was asked to end: what it computes is thrown away. Takes some nanoseconds; to be
/// asked after some ten thousand operations.
bool must_stop();

}  // namespace rpf
