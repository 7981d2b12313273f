#include "cli/manual_command.h"

#include "cli/choices.h"
#include "cli/option_texts.h"
#include "cli/print.h"
#include "rpf/version.h"

namespace rpf::cli {

Command add_manual_command(CLI::App& app) {
  auto form = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("manual", "Print the manual page, or what completes this command in a shell");
  command->group("");  // for packages
  command->add_option("FORM", *form, "man, bash, zsh or fish")
      ->required()
      ->check(one_of({"man", "bash", "zsh", "fish"}));
  return [form, &app] {
    const std::vector<CommandText> commands = command_texts(app);
    print_text(*form == "man"    ? manual_page(commands, version(), app.get_footer())
               : *form == "bash" ? bash_completion(commands)
               : *form == "zsh"  ? zsh_completion(commands)
                                 : fish_completion(commands));
    return 0;
  };
}

}  // namespace rpf::cli
