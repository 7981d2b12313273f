#include "opencl/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "opencl/kernel_cache.h"
#include "parts/parts.h"
#include "rpf/error.h"

namespace rpf {
namespace {

using Clock = std::chrono::steady_clock;

/// What a driver may take to clean up after a whole answer.
constexpr auto to_end = std::chrono::seconds(1);

/// Behind the limit. A machine with much else to do is not taken for a driver that hangs: that one wants no processor.
bool is_hopeless(double waited, double wanted, double worked, double limit) {
  constexpr double least_share = 0.02, longest = 10;  // limits
  return wanted < least_share * waited || worked > limit || waited > longest * limit;
}

std::string helper() {
  for (const std::string& place : places_of_part(RPF_PROBE_NAME))
    if (::access(place.c_str(), X_OK) == 0) return place;
  throw Error(ErrorKind::device, "OpenCL drivers are asked by " RPF_PROBE_NAME
                                 ", which is not beside the program; put it there, or use --backend=cpu");
}

/// Both ends of a pipe, closed with it and in the child.
struct Pipe {
  std::array<int, 2> ends{-1, -1};

  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw Error(ErrorKind::device, fmt::format("no pipe to ask an OpenCL driver ({}); raise `ulimit -n`",
                                                 std::system_category().message(errno)));
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close(0);
    close(1);
  }
  void close(std::size_t end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
  }
};

/// A text as a file without a name, to be read from its beginning.
struct File {
  int descriptor = ::memfd_create("rpf", MFD_CLOEXEC);

  explicit File(const std::string& text) {
    std::size_t done = 0;
    for (ssize_t count = 1; count > 0 && done < text.size();
         done += static_cast<std::size_t>(std::max<ssize_t>(count, 0)))
      count = ::write(descriptor, text.data() + done, text.size() - done);
    if (done < text.size() || ::lseek(descriptor, 0, SEEK_SET) != 0)
      throw Error(ErrorKind::device, "no memory to ask an OpenCL driver");
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The rest of what a pipe holds, and whether more may come.
bool take(int descriptor, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
  if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

class Child {
 public:
  Child(const std::vector<std::string>& question, const std::string& input) {
    const File text(input);
    std::vector<std::string> arguments{helper()}, environment = environment_with_our_cache();
    arguments.insert(arguments.end(), question.begin(), question.end());
    posix_spawn_file_actions_t streams;
    ::posix_spawn_file_actions_init(&streams);
    ::posix_spawn_file_actions_adddup2(&streams, text.descriptor, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&streams, answer_.ends[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&streams, words_.ends[1], STDERR_FILENO);
    const int failed = ::posix_spawn(&id_, arguments.front().c_str(), &streams, nullptr, pointers_to(arguments).data(),
                                     pointers_to(environment).data());
    ::posix_spawn_file_actions_destroy(&streams);
    if (failed != 0)
      throw Error(
          ErrorKind::device,
          fmt::format("\"{}\", which asks OpenCL drivers, cannot be started ({}); put it right, or use --backend=cpu",
                      arguments.front(), std::system_category().message(failed)));
    answer_.close(1);
    words_.close(1);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (ended_) return;
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }

  ChildAnswer wait(std::chrono::seconds limit, const Check& check) {
    const auto start = Clock::now();
    std::chrono::duration<double> waited{0}, wanted{0};  // wanted: a processor, whether it got one or not
    while (!has_ended() && !is_answered()) {
      const auto before = waited;
      waited = Clock::now() - start;
      if (wants_processor()) wanted += waited - before;
      if (waited > limit && is_hopeless(waited.count(), wanted.count(), processor_seconds(), limit.count()))
        return {false, false, fmt::format("gave no answer in {:.0f} seconds", waited.count())};
      if (check) check();
      listen();
    }
    for (const auto end = Clock::now() + to_end; !ended_ && !has_ended() && Clock::now() < end;) listen();
    for (Pipe* pipe : {&answer_, &words_}) ::fcntl(pipe->ends[0], F_SETFL, O_NONBLOCK);  // a child of it may go on
    while (take(answer_.ends[0], text_)) {
    }
    while (take(words_.ends[0], last_words_)) {
    }
    const std::size_t end = text_.rfind(end_of_answer);
    if (end != std::string::npos) return {true, false, text_.substr(0, end)};
    return {false, was_stopped(), how_it_ended()};
  }

 private:
  /// Of all its threads.
  double processor_seconds() const {
    clockid_t clock = 0;
    timespec used{};
    if (::clock_getcpuclockid(id_, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0;
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
  }

  /// Whether one of its threads runs, waits for a processor or for a disk.
  bool wants_processor() const {
    std::error_code gone;
    std::filesystem::directory_iterator thread(fmt::format("/proc/{}/task", id_), gone);
    for (; !gone && thread != std::filesystem::directory_iterator(); thread.increment(gone)) {
      std::string text;
      std::ifstream file(thread->path() / "stat");  // "ID (name) R ..."; a name may hold anything
      if (!std::getline(file, text, '\0')) continue;
      const std::size_t state = text.rfind(") ");
      if (state != std::string::npos && std::strchr("RD", text[state + 2]) != nullptr) return true;
    }
    return false;
  }

  bool has_ended() {
    ended_ = ::waitpid(id_, &status_, WNOHANG) != 0;  // an error too: the caller ignores SIGCHLD
    return ended_;
  }

  bool is_answered() const { return text_.find(end_of_answer) != std::string::npos; }

  void listen() {
    constexpr int milliseconds = 20;
    pollfd streams[] = {{answer_.ends[0], POLLIN, 0}, {words_.ends[0], POLLIN, 0}};
    if (::poll(streams, std::size(streams), milliseconds) <= 0) return;
    if (streams[0].revents != 0 && !take(answer_.ends[0], text_)) answer_.close(0);
    if (streams[1].revents != 0 && !take(words_.ends[0], last_words_)) words_.close(0);
    if (answer_.ends[0] < 0) ::poll(nullptr, 0, 1);  // it is ending
  }

  /// By the terminal, the user or the machine.
  bool was_stopped() const {
    constexpr std::array<int, 4> from_outside = {SIGINT, SIGTERM, SIGHUP, SIGKILL};
    return WIFSIGNALED(status_) &&
           std::find(from_outside.begin(), from_outside.end(), WTERMSIG(status_)) != from_outside.end();
  }

  std::string how_it_ended() const {
    std::string text = WIFSIGNALED(status_)
                           ? fmt::format("ended the process that asked it ({})", ::strsignal(WTERMSIG(status_)))
                           : fmt::format("ended the process that asked it (exit code {})", WEXITSTATUS(status_));
    const std::string said = last_line(last_words_);  // without its full stop: more is said behind it
    return said.empty() ? text : text + ": " + said;
  }

  static std::string last_line(const std::string& words) {
    constexpr std::size_t longest = 300;
    const std::size_t last = words.find_last_not_of("\r\n\t .");
    if (last == std::string::npos) return {};
    const std::size_t begin = words.find_last_of('\n', last) + 1;
    std::string line = words.substr(begin, std::min(last + 1 - begin, longest));
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
    return line;
  }

  Pipe answer_, words_;
  pid_t id_ = 0;
  int status_ = 0;
  bool ended_ = false;
  std::string text_, last_words_;
};

}  // namespace

ChildAnswer ask_child(const std::vector<std::string>& question, const std::string& input, std::chrono::seconds limit,
                      const Check& check) {
  return Child(question, input).wait(limit, check);
}

}  // namespace rpf
