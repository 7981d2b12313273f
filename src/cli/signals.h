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

/// Beside a SignalGuard, while nothing is being written: where the work has not stopped a second after a signal,
/// because it is inside a driver or a library, the process ends.
class LastResort {
 public:
  LastResort();
  ~LastResort();
  LastResort(const LastResort&) = delete;
  LastResort& operator=(const LastResort&) = delete;

 private:
  void (*former_)(int);
};

/// The latest remembered signal, 0 if none.
int received_signal();

}  // namespace rpf::cli
