#include "opencl/kernel_source.h"

#include <fmt/format.h>

#include <sstream>

#include "rpf/error.h"

namespace rpf {
namespace {

const std::string include_directive = "#include \"";

void append(const std::string& name, std::string& source) {
  const auto file = kernel_files().find(name);
  if (file == kernel_files().end()) throw Error(ErrorKind::internal, "kernel file " + name + " is not in the library");
  source += fmt::format("#line 1 \"{}\"\n", name);
  std::istringstream lines(file->second);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.compare(0, include_directive.size(), include_directive) != 0) {
      source += line + "\n";
      continue;
    }
    const std::size_t begin = include_directive.size();
    append(line.substr(begin, line.find('"', begin) - begin), source);
    source += fmt::format("#line {} \"{}\"\n", number + 1, name);
  }
}

}  // namespace

std::string kernel_source(const std::string& name) {
  std::string source;
  append(name, source);
  return source;
}

}  // namespace rpf
