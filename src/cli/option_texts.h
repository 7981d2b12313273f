// What the parser knows of commands and options, as plain data: manual pages and completion are made of it, so that no
// text exists twice.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace rpf::cli {

struct OptionText {
  std::vector<std::string> names;    ///< "-o", "--output"; none of a positional argument
  std::string value;                 ///< what it takes: "FILE", "FLOAT"; of a positional its name; empty of a flag
  std::vector<std::string> choices;  ///< where only these are taken
  std::string fallback;              ///< what it is where it is not given; empty: nothing
  std::string description, group;
  bool takes_file = false;
};

struct CommandText {
  std::string path;  ///< "", "info", "bench frames"
  std::string description;
  std::vector<OptionText> options;
  std::vector<std::string> subcommands;
};

/// The command itself first, then each of its commands.
std::vector<CommandText> command_texts(const CLI::App& app);

/// A manual page (roff) of all commands. `examples`: what stands below the help.
std::string manual_page(const std::vector<CommandText>& commands, const std::string& version,
                        const std::string& examples);

std::string bash_completion(const std::vector<CommandText>& commands);
std::string zsh_completion(const std::vector<CommandText>& commands);
std::string fish_completion(const std::vector<CommandText>& commands);

}  // namespace rpf::cli
