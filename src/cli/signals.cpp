#include "cli/signals.h"

#include <unistd.h>

#include <csignal>

namespace rpf::cli {
namespace {

constexpr std::array<int, 3> handled = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t latest_signal = 0;

volatile std::sig_atomic_t may_end = 0;  ///< inside a LastResort

// What handlers do they may do: alarm(), write() and _exit() are safe there.
extern "C" void remember(int number) {
  latest_signal = number;
  if (may_end != 0) ::alarm(1);
}

extern "C" void end(int /*number*/) {
  constexpr char message[] = "rpf: error: cancelled\n";
  if (may_end == 0) return;
  static_cast<void>(::write(STDERR_FILENO, message, sizeof message - 1) < 0);
  ::_exit(128 + latest_signal);
}

}  // namespace

SignalGuard::SignalGuard() {
  for (std::size_t i = 0; i < handled.size(); ++i) {
    former_[i] = std::signal(handled[i], remember);
    if (former_[i] == SIG_IGN) std::signal(handled[i], SIG_IGN);
  }
}

SignalGuard::~SignalGuard() {
  for (std::size_t i = 0; i < handled.size(); ++i) std::signal(handled[i], former_[i]);
}

LastResort::LastResort() : former_(std::signal(SIGALRM, end)) { may_end = 1; }

LastResort::~LastResort() {
  may_end = 0;
  ::alarm(0);
  std::signal(SIGALRM, former_);
}

int received_signal() { return latest_signal; }

}  // namespace rpf::cli
