#include "bench/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
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

/// Starts the program with its standard output in the pipe's end `out`.
pid_t start(const std::vector<std::string>& command, int out) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  pid_t child = -1;
  const int failure = posix_spawnp(&child, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0)
    throw Error(ErrorKind::usage, fmt::format("\"{}\" cannot be started: {}", command.front(), std::strerror(failure)));
  return child;
}

/// Everything that comes out of the pipe until its other end is closed. `was_stopped`: by a signal to this process.
std::string read_all(int in, pid_t child, bool& was_stopped) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    pollfd ready{in, POLLIN, 0};
    if (poll(&ready, 1, -1) < 0 && errno == EINTR) {  // a signal; read() would be restarted behind our back
      kill(child, SIGTERM);
      was_stopped = true;
      continue;
    }
    const ssize_t count = read(in, part.data(), part.size());
    if (count <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
  }
}

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
  bool was_stopped = false;
  std::string text = read_all(ends[0], child, was_stopped);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (code != 0 && was_stopped) throw Error(ErrorKind::cancelled, "cancelled");
  if (code != 0) throw Error(kind_of(code), fmt::format("\"{}\" ended with exit code {}", command.front(), code));
  return text;
}

}  // namespace rpf::bench
