#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/option_texts.h"

namespace rpf::cli {
namespace {

/// Between single quotes of a shell; one line.
std::string quoted(std::string text) {
  text = text.substr(0, text.find('\n'));
  std::string result;
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + result + "'";
}

/// For zsh's _arguments, in which brackets and colons mean something.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_action(const OptionText& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  return option.takes_file ? "_files" : " ";
}

std::string zsh_option(const OptionText& option) {
  std::string lines;
  const std::string value =
      option.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option));
  for (const std::string& name : option.names) {
    const std::string attached = option.value.empty() ? "" : name.rfind("--", 0) == 0 ? "=" : "+";
    lines += fmt::format("    {}\n",
                         quoted(fmt::format("*{}{}[{}]{}", name, attached, zsh_text(option.description), value)));
  }
  return lines;
}

std::string function_of(const CommandText& command) {
  std::string name = "_rpf_" + command.path;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
  return name;
}

std::string fish_condition(const CommandText& command) {
  if (command.path.empty()) return "__fish_use_subcommand";
  const std::size_t space = command.path.rfind(' ');
  return "__fish_seen_subcommand_from " + command.path.substr(space == std::string::npos ? 0 : space + 1);
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands) {
  std::string words, choices;
  for (const CommandText& command : commands) {
    std::vector<std::string> names = command.subcommands;
    for (const OptionText& option : command.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
      for (const std::string& name : option.choices.empty() ? std::vector<std::string>{} : option.names)
        choices += fmt::format("    '{} {}') words='{}' ;;\n", command.path, name, fmt::join(option.choices, " "));
    }
    words += fmt::format("    '{}') words='{}' ;;\n", command.path, fmt::join(names, " "));
  }
  std::vector<std::string> paths;
  for (const CommandText& command : commands) paths.push_back(fmt::format("'{}'", command.path));
  return fmt::format(
      "# bash completion of rpf, made from its options\n_rpf() {{\n  local word=${{COMP_WORDS[COMP_CWORD]}} "
      "before=${{COMP_WORDS[COMP_CWORD-1]}} path='' words='' given\n"
      "  for given in \"${{COMP_WORDS[@]:1:COMP_CWORD-1}}\"; do\n    case \"${{path:+$path }}$given\" in {}) "
      "path=\"${{path:+$path "
      "}}$given\" ;; esac\n  done\n  case \"$path $before\" in\n{}  esac\n  if [[ -z $words && $word == -* || -z "
      "$words && -z $word ]]; "
      "then\n    case \"$path\" in\n{}    esac\n  fi\n  [[ -n $words ]] && mapfile -t COMPREPLY < <(compgen -W "
      "\"$words\" -- "
      "\"$word\")\n}}\ncomplete -o default -F _rpf rpf\n",
      fmt::join(paths.begin() + 1, paths.end(), "|"), choices, words);
}

std::string zsh_completion(const std::vector<CommandText>& commands) {
  std::string text = "#compdef rpf\n# zsh completion of rpf, made from its options\n";
  for (const CommandText& command : commands) {
    text += fmt::format("{}() {{\n  local -a options=(\n", function_of(command));
    for (const OptionText& option : command.options) text += zsh_option(option);
    text += "    '*:file:_files'\n  )\n";
    if (!command.subcommands.empty()) {
      text += "  local word\n  for word in ${words[2,CURRENT-1]}; do\n    case $word in\n";
      for (const std::string& child : command.subcommands) {
        CommandText named{command.path + (command.path.empty() ? "" : " ") + child, "", {}, {}};
        text += fmt::format("      {}) shift words; (( CURRENT-- )); {}; return ;;\n", child, function_of(named));
      }
      text += fmt::format("    esac\n  done\n  compadd -- {}\n", fmt::join(command.subcommands, " "));
    }
    text += "  _arguments -s $options\n}\n";
  }
  return text + "_rpf_ \"$@\"\n";
}

std::string fish_completion(const std::vector<CommandText>& commands) {
  std::string text = "# fish completion of rpf, made from its options\n";
  for (const CommandText& command : commands) {
    const std::string when = fmt::format("complete -c rpf -n {}", quoted(fish_condition(command)));
    for (const std::string& child : command.subcommands)
      for (const CommandText& other : commands)
        if (other.path == command.path + (command.path.empty() ? "" : " ") + child)
          text += fmt::format("{} -a {} -d {}\n", when, child, quoted(other.description));
    for (const OptionText& option : command.options) {
      if (option.names.empty()) continue;
      text += when;
      for (const std::string& name : option.names)
        text += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.value.empty()) text += option.takes_file ? " -r" : " -x";
      if (!option.choices.empty()) text += fmt::format(" -a '{}'", fmt::join(option.choices, " "));
      text += fmt::format(" -d {}\n", quoted(option.description));
    }
  }
  return text;
}

}  // namespace rpf::cli
