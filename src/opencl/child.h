// The program beside ours that asks an OpenCL driver: whatever a driver does there, this process goes on.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace rpf {

/// Called now and then while a child works; what it throws ends the child, and is passed on.
using Check = std::function<void()>;

struct ChildAnswer {
  bool complete = false;  ///< else the child ended before it, or took too long
  bool stopped = false;   ///< not complete, because somebody else ended the child: it says nothing about the driver
  std::string text;       ///< the answer, or how the child ended with its last words
};

/// Runs rpf_probe (src/probe) with these arguments, and `input` on its standard input, and waits for its answer,
/// `limit` of its work. Throws Error(device) where that program is missing.
ChildAnswer ask_child(const std::vector<std::string>& question, const std::string& input, std::chrono::seconds limit,
                      const Check& check);

/// What rpf_probe prints behind a whole answer.
constexpr const char* end_of_answer = "\nend of answer\n";

}  // namespace rpf
