#include "command_line_errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "core/gltf/name_choice.h"
#include "file_ending.h"
#include "messages.h"

namespace photopic {
namespace {

/// The first that looks like an option and is none.
std::optional<std::string> unknown_option(const CLI::App& command, const std::vector<std::string>& extras) {
  for (const std::string& extra : extras) {
    const std::string name = extra.substr(0, extra.find('='));
    if (name.size() > 1 && name[0] == '-' && command.get_option_no_throw(name) == nullptr) return name;
  }
  return std::nullopt;
}

/// What may have been meant: the first that begins so, else the likest of those that are but two slips away;
/// else nothing.
std::string resembling(const std::vector<std::string>& known, const std::string& name) {
  std::size_t least = 3;
  std::string meant;
  for (const std::string& candidate : known) {
    const std::size_t slips = candidate.starts_with(name) ? 0 : edit_distance(candidate, name);
    if (slips < least) least = slips, meant = candidate;
  }
  return meant.empty() ? "" : fmt::format(" ({}?)", meant);
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) names.push_back(option->get_name());
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

bool is_scene(const std::string& word) {
  const std::string ending = lower_case_ending(word);
  return ending == ".gltf" || ending == ".glb";
}

/// The options behind whose value a further word stands that is no scene. It was meant for the option, but
/// was taken for SCENE or the like, and that then for one too many.
std::vector<const CLI::Option*> options_with_further_words(const CLI::App& command,
                                                           const std::vector<std::string>& words) {
  std::vector<const CLI::Option*> options;
  const CLI::Option* option = nullptr;  // whose words these are
  bool has_value = false;
  for (const std::string& word : words) {
    if (word.size() > 1 && word[0] == '-') {
      option = command.get_option_no_throw(word.substr(0, word.find('=')));
      if (option != nullptr && option->get_items_expected_max() == 0) option = nullptr;
      has_value = word.find('=') != word.npos;
    } else if (option != nullptr && has_value && !is_scene(word)) {
      if (std::ranges::find(options, option) == options.end()) options.push_back(option);
    } else {
      has_value = true;
    }
  }
  return options;
}

std::string positional_name(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) return option->get_name();
  return "COMMAND";
}

/// What to do about words that are too many.
std::string remedy_of_extras(const CLI::App& command, const std::vector<std::string>& words) {
  const std::string positional = positional_name(command);
  if (positional != "SCENE") return "; give one " + positional;
  std::string remedy;
  std::vector<std::string> repeated;
  for (const CLI::Option* option : options_with_further_words(command, words)) {
    if (option->get_expected_max() > 1)
      repeated.push_back(option->get_name());
    else
      remedy += fmt::format("; {} takes one value, {}", option->get_name(), option->get_type_name());
  }
  if (!repeated.empty()) remedy += fmt::format("; give {} anew before each value", fmt::join(repeated, ", "));
  return remedy.empty() ? "; give one SCENE" : remedy;
}

/// The problem with an option's number of values, where the parser's words tell little; else its words.
std::string problem_of_count(const CLI::App& command, const CLI::ParseError& error) {
  const std::string words = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return words;
  for (const CLI::Option* option : command.get_options()) {
    if (!words.starts_with(option->get_name() + ":")) continue;
    const auto most = static_cast<std::size_t>(option->get_items_expected_max());
    if (option->count() > most)
      return fmt::format("{} is given {} times; give it once", option->get_name(), option->count());
    return fmt::format("{}: its value is missing", option->get_name());
  }
  return words;
}

/// An option that there is not goes before one that is missing: it may be that one, misspelt.
std::string problem_of(const CLI::App& command, const CLI::ParseError& error,
                       const std::vector<std::string>& words) {
  std::vector<std::string> extras = command.remaining();
  std::erase(extras, "--");
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (extra || dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    if (const auto name = unknown_option(command, extras))
      return fmt::format("{}: there is no such option{}", *name, resembling(option_names(command), *name));
  if (!extra) return problem_of_count(command, error);
  return fmt::format("not expected: {}{}", fmt::join(extras, " "), remedy_of_extras(command, words));
}

}  // namespace

int explain(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  if (error.get_exit_code() == 0) return app.exit(error, std::cout, std::cerr);
  const auto chosen = app.get_subcommands();
  if (chosen.empty() && app.remaining_size() > 0) {
    const std::string name = app.remaining().front();
    print_error(fmt::format("{}: there is no such command{}; see photopic --help", name,
                            resembling(command_names(app), name)));
  } else {
    const std::string name = chosen.empty() ? "" : " " + chosen.front()->get_name();
    const std::string problem = problem_of(chosen.empty() ? app : *chosen.front(), error, words);
    print_error(fmt::format("{}; see photopic{} --help", problem, name));
  }
  return kExitBadInput;
}

}  // namespace photopic
