#include "parallel/workers.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <chrono>
#include <future>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rpf {
namespace {

using testing::Each;

TEST(WorkersTest, DoEverythingOnceWhateverTheirNumber) {
  for (const int threads : {1, 2, 3, 16, 100})
    for (const std::size_t count : {0U, 1U, 2U, 99U, 10000U}) {
      std::vector<int> done(count + 5, 0);
      Workers(threads).for_all(5, count + 5, [&](std::size_t i, std::size_t /*worker*/) { ++done[i]; });
      EXPECT_THAT(std::vector<int>(done.begin(), done.begin() + 5), Each(0));
      EXPECT_THAT(std::vector<int>(done.begin() + 5, done.end()), Each(1)) << threads << " threads, " << count;
    }
}

TEST(WorkersTest, AreSeveralThreadsAndOneOfThemIsTheCaller) {
  constexpr std::size_t threads = 4;
  std::vector<std::thread::id> ids(threads);
  std::atomic<std::size_t> begun{0};
  Workers(threads).for_all(0, threads, [&](std::size_t /*index*/, std::size_t worker) {
    ids[worker] = std::this_thread::get_id();
    ++begun;
    while (begun < threads) std::this_thread::yield();  // so that none does the work of two
  });
  EXPECT_EQ(std::set<std::thread::id>(ids.begin(), ids.end()).size(), threads);
  EXPECT_EQ(ids[0], std::this_thread::get_id());
}

TEST(WorkersTest, PassOnWhatABodyThrowsAndBeginNoMore) {
  Workers workers(2);
  std::atomic<int> done{0};
  const auto body = [&](std::size_t i, std::size_t /*worker*/) {
    if (i == 3) throw std::runtime_error("the fourth");
    ++done;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  EXPECT_THROW(workers.for_all(0, 100000, body), std::runtime_error);
  EXPECT_LT(done, 100000 - 1);
}

TEST(WorkersTest, StopWithinABodyThatAsks) {
  Workers workers(2);
  std::promise<void> begun;
  std::atomic<int> count{0};
  std::future<void> work = std::async(std::launch::async, [&] {
    workers.for_all(0, 1000, [&](std::size_t /*index*/, std::size_t /*worker*/) {
      if (++count == 2) begun.set_value();
      while (!must_stop()) std::this_thread::yield();
    });
  });
  begun.get_future().wait();
  workers.stop();
  work.get();
  EXPECT_EQ(count, 2);
  EXPECT_FALSE(must_stop());  // here nobody is asked
}

TEST(WorkersTest, DoWithoutThreadsThatCannotBeHad) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer itself needs memory for every thread, and ends the process without";
#endif
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit little{std::size_t{1} << 30, before.rlim_max};
  EXPECT_EXIT(
      {
        setrlimit(RLIMIT_AS, &little);
        std::vector<int> done(1000, 0);
        Workers(1000).for_all(0, 1000, [&](std::size_t i, std::size_t /*worker*/) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
          ++done[i];
        });
        _exit(done == std::vector<int>(1000, 1) ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace rpf
