#pragma once

#include <array>

namespace rpf::cli {

/// While one exists, SIGINT, SIGTERM and SIGHUP are remembered instead of ending the process, so that a run can stop
/// between two tiles and clean up. Outside, they act as usual. A signal that the parent ignores stays ignored: nohup.
class SignalGuard {
 public:
  SignalGuard();
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  std::array<void (*)(int), 3> former_{};
};

/// The latest remembered signal, 0 if none.
int received_signal();

}  // namespace rpf::cli
