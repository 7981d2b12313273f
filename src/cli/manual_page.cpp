#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/option_texts.h"

namespace rpf::cli {
namespace {

/// What roff would take for its own: backslashes, hyphens of options, and dots and quotes that begin a line.
std::string roff(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) result += "\\&";
    if (text[i] == '\\')
      result += "\\e";
    else if (text[i] == '-')
      result += "\\-";
    else if (text[i] == '\n')
      result += "\n.br\n";
    else
      result += text[i];
  }
  return result;
}

std::string entry(const OptionText& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back(fmt::format("\\fB{}\\fR", roff(name)));
  const std::string value = option.choices.empty() ? option.value : fmt::format("{}", fmt::join(option.choices, "|"));
  std::string head = fmt::format("{}", fmt::join(names, ", "));
  if (!value.empty()) head += fmt::format("{}\\fI{}\\fR", head.empty() ? "" : " ", roff(value));
  const std::string fallback = option.fallback.empty() ? "" : fmt::format(" (default: {})", roff(option.fallback));
  return fmt::format(".TP\n{}\n{}{}\n", head, roff(option.description), fallback);
}

std::string options_of(const CommandText& command) {
  std::string text, group;
  for (const OptionText& option : command.options) {
    if (command.path.empty() && option.group != group && !option.names.empty())
      text += fmt::format(".SS {}\n", roff(option.group));
    if (!option.names.empty()) group = option.group;
    text += entry(option);
  }
  return text;
}

}  // namespace

std::string manual_page(const std::vector<CommandText>& commands, const std::string& version,
                        const std::string& examples) {
  std::string text = fmt::format(
      ".TH RPF 1 \"\" \"rpf {}\" \"User Commands\"\n.SH NAME\nrpf \\- filter the noise of Monte Carlo renderings, from "
      "their samples\n.SH SYNOPSIS\n.B rpf\n[\\fIOPTIONS\\fR] \\fIINPUT\\fR \\-o \\fIOUTPUT\\fR\n.br\n.B "
      "rpf\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n{}\n.SH OPTIONS\n{}.SH COMMANDS\n",
      version, roff(commands.front().description), options_of(commands.front()));
  for (std::size_t i = 1; i < commands.size(); ++i)
    text += fmt::format(".SS rpf {}\n{}\n{}", roff(commands[i].path), roff(commands[i].description),
                        options_of(commands[i]));
  return text + fmt::format(".SH EXAMPLES AND EXIT CODES\n.nf\n{}\n.fi\n", roff(examples));
}

}  // namespace rpf::cli
