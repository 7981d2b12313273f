#include "bench/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "rpf/error.h"

extern char** environ;

namespace rpf::bench {
namespace {

ErrorKind kind_of(int exit_code) {
  const bool known =
      exit_code >= static_cast<int>(ErrorKind::internal) && exit_code <= static_cast<int>(ErrorKind::memory);
  if (exit_code > 128) return ErrorKind::cancelled;
  return known ? static_cast<ErrorKind>(exit_code) : ErrorKind::internal;
}

/// Starts the program with its standard output in the pipe's end `out`, as the leader of a group of processes: what it
/// starts itself ends with it.
pid_t start(const std::vector<std::string>& command, int out) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = -1;
  const int failure = posix_spawnp(&child, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0)
    throw Error(ErrorKind::usage, fmt::format("\"{}\" cannot be started: {}", command.front(), std::strerror(failure)));
  return child;
}

using Clock = std::chrono::steady_clock;

/// What a child prints, until it ends or has to.
class Output {
 public:
  Output(int in, pid_t child) : in_(in), child_(child) {}

  /// Everything that comes out of the pipe until its other end is closed. A signal to this process ends the child and
  /// what that has started: it is asked to, and made to where it does not.
  std::string read_all() {
    std::string text;
    std::array<char, 4096> part{};
    while (wait()) {
      const ssize_t count = read(in_, part.data(), part.size());
      if (count <= 0) break;
      text.append(part.data(), static_cast<std::size_t>(count));
    }
    return text;
  }
  /// How the child ended, as waitpid() has it: it may have closed the pipe long before.
  int wait_for_end() {
    int status = 0;
    while (waitpid(child_, &status, WNOHANG) == 0) {
      if (poll(nullptr, 0, glance) < 0 && errno == EINTR) cancel();
      if (is_out_of_patience()) kill(-child_, SIGKILL);
    }
    return status;
  }
  bool was_cancelled() const { return was_cancelled_; }

 private:
  /// Until there is something to read; false where the child was made to end.
  bool wait() {
    while (!is_out_of_patience()) {
      pollfd ready{in_, POLLIN, 0};
      const int found = poll(&ready, 1, was_cancelled_ ? glance : -1);
      if (found > 0) return true;
      if (found < 0 && errno == EINTR) cancel();  // a signal; read() would be restarted behind our back
    }
    kill(-child_, SIGKILL);
    return false;
  }

  bool is_out_of_patience() const { return was_cancelled_ && Clock::now() > end_; }

  void cancel() {
    if (was_cancelled_) return;
    kill(-child_, SIGTERM);
    was_cancelled_ = true;
    end_ = Clock::now() + std::chrono::seconds(1);
  }

  static constexpr int glance = 10;  ///< ms between two looks at the clock

  int in_;
  pid_t child_;
  bool was_cancelled_ = false;
  Clock::time_point end_;  ///< of patience
};

}  // namespace

std::string output_of(const std::vector<std::string>& command) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(ErrorKind::internal, "no pipe can be made");
  pid_t child = -1;
  try {
    child = start(command, ends[1]);
  } catch (...) {
    close(ends[0]);
    close(ends[1]);
    throw;
  }
  close(ends[1]);
  Output output(ends[0], child);
  std::string text = output.read_all();
  close(ends[0]);
  const int status = output.wait_for_end();
  if (output.was_cancelled()) throw Error(ErrorKind::cancelled, "cancelled");
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (code != 0) throw Error(kind_of(code), fmt::format("\"{}\" ended with exit code {}", command.front(), code));
  return text;
}

}  // namespace rpf::bench
