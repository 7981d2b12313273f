// rpf_probe: asks an OpenCL driver in a process of its own (src/opencl/child.h). Not for users.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <string>

#include "opencl/probe.h"
#include "rpf/error.h"

namespace {

/// Ends with the program that asks, and leaves no core behind.
void belong_to_the_caller() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
}

/// Where the answer goes. What drivers print on standard output joins their other words, and is no part of it.
int take_standard_output() {
  const int answers = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  return answers;
}

std::string answer(int argc, char** argv) {
  try {
    return rpf::answer_probe({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    return std::to_string(static_cast<int>(rpf::ErrorKind::device)) + "\n" + e.what();
  }
}

}  // namespace

int main(int argc, char** argv) {
  belong_to_the_caller();
  const int answers = take_standard_output();
  const std::string text = answer(argc, argv) + rpf::end_of_answer;
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(answers, text.data() + done, text.size() - done);
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  return 0;  // not _exit(): drivers remove temporary files at the end
}
