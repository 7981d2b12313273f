#include "cli/option_texts.h"

#include <algorithm>

namespace rpf::cli {
namespace {

/// "TEXT:{thesis,paper}" has choices.
std::vector<std::string> choices_in(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t begin = type.find(":{"), end = type.rfind('}');
  if (begin == std::string::npos || end == std::string::npos) return choices;
  for (std::size_t at = begin + 2; at < end;) {
    const std::size_t comma = std::min(type.find(',', at), end);
    choices.push_back(type.substr(at, comma - at));
    at = comma + 1;
  }
  return choices;
}

OptionText text_of(const CLI::Option& option) {
  OptionText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) {
    const std::string type = option.get_type_name();
    text.choices = choices_in(type);
    text.value = text.names.empty() ? option.get_name(true) : type.substr(0, type.find(':'));
    text.takes_file = type.find("FILE") != std::string::npos || type.find("DIR") != std::string::npos ||
                      text.value.find("FILE") != std::string::npos;
    text.fallback = option.get_default_str();
  }
  text.description = option.get_description();
  text.group = option.get_group();
  return text;
}

void add(const CLI::App& app, const std::string& path, std::vector<CommandText>& commands) {
  CommandText command{path, app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) command.options.push_back(text_of(*option));
  const auto children = app.get_subcommands([](const CLI::App* child) { return !child->get_group().empty(); });
  for (const CLI::App* child : children) command.subcommands.push_back(child->get_name());
  commands.push_back(command);
  for (const CLI::App* child : children) add(*child, path + (path.empty() ? "" : " ") + child->get_name(), commands);
}

}  // namespace

std::vector<CommandText> command_texts(const CLI::App& app) {
  std::vector<CommandText> commands;
  add(app, "", commands);
  return commands;
}

}  // namespace rpf::cli
