#include "cli/signals.h"

#include <csignal>

namespace rpf::cli {
namespace {

constexpr std::array<int, 3> handled = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t latest_signal = 0;

extern "C" void remember(int number) { latest_signal = number; }

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

int received_signal() { return latest_signal; }

}  // namespace rpf::cli
