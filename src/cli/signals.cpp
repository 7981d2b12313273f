#include "cli/signals.h"

#include <csignal>

namespace rpf::cli {
namespace {

constexpr int handled[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t latest_signal = 0;

extern "C" void remember(int number) { latest_signal = number; }

}  // namespace

SignalGuard::SignalGuard() {
  for (const int number : handled) std::signal(number, remember);
}

SignalGuard::~SignalGuard() {
  for (const int number : handled) std::signal(number, SIG_DFL);
}

int received_signal() { return latest_signal; }

}  // namespace rpf::cli
