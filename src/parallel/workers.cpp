#include "parallel/workers.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace rpf {
namespace {

/// Of the Workers that this thread works for.
thread_local const std::atomic<bool>* stop_here = nullptr;

class WorksFor {
 public:
  explicit WorksFor(const std::atomic<bool>& stop) : before_(stop_here) { stop_here = &stop; }
  WorksFor(const WorksFor&) = delete;
  WorksFor& operator=(const WorksFor&) = delete;
  ~WorksFor() { stop_here = before_; }

 private:
  const std::atomic<bool>* before_;
};

/// The first of what several threads throw.
class Failure {
 public:
  void keep(std::exception_ptr failure) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr failure_;
};

/// Runs `work`(0) here and as many more as threads can be had for; all have ended when it returns.
void on_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::thread> others;
  others.reserve(count - 1);
  try {
    while (others.size() + 1 < count) others.emplace_back(work, others.size() + 1);
  } catch (const std::system_error&) {  // a limit of processes, or of memory: the others do all of it
  }
  work(0);
  for (std::thread& other : others) other.join();
}

}  // namespace

void Workers::for_all(std::size_t first, std::size_t end, const Body& body) {
  if (first >= end) return;
  std::atomic<std::size_t> next{first};
  Failure failure;
  on_threads(std::min(count(), end - first), [&](std::size_t worker) {
    const WorksFor here(stop_);
    try {
      for (std::size_t i = next++; i < end && !stop_; i = next++) body(i, worker);
    } catch (...) {
      failure.keep(std::current_exception());
      stop();
    }
  });
  failure.rethrow();
}

bool must_stop() { return stop_here != nullptr && *stop_here; }

}  // namespace rpf
