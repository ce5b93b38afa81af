#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace photopic {

/// What several subcommands' bindings share.

inline constexpr const char* kSpectrumHelp =
    "\nSPECTRUM is a file (two columns nm, value; LSPDD .csv/.json; CGATS .sp; TM-27 .spdx), "
    "cie:A|D50|D65|E|FL1…FL12|…,\n"
    "blackbody:KELVIN, line:NM[:FWHM] or constant.";

inline CLI::Validator one_of(std::vector<std::string> names) {
  return CLI::IsMember(std::move(names));
}

/// An empty name would be taken for none given.
inline CLI::Validator not_empty() {
  return {[](std::string& text) { return text.empty() ? std::string("it is empty") : std::string(); }, ""};
}

/// [EV]
inline CLI::Validator exposure_range() {
  const auto check = [](std::string& text) {
    double value = 0;
    const bool good =
        CLI::detail::lexical_cast(text, value) && std::isfinite(value) && std::abs(value) <= 100;
    return good ? std::string() : "Value " + text + " is not a number from -100 to 100";
  };
  return {check, "-100…100"};
}

inline void bind_seed(CLI::App& command, std::uint32_t& seed) {
  command.add_option("--seed", seed, "Same seed, same bits, whatever the number of threads")
      ->capture_default_str()
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{UINT32_MAX}))
      ->type_name("N");
}

inline void bind_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use; 0: as many as the machine runs at once")
      ->capture_default_str()
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
}

inline void bind_json(CLI::App& command, std::filesystem::path& json) {
  command
      .add_option("--json", json,
                  "Write the result for machines to read; - or /dev/stdout is standard output, where nothing "
                  "else then goes")
      ->check(not_empty())
      ->transform([](const std::string& name) { return name == "-" ? std::string("/dev/stdout") : name; }, "")
      ->type_name("FILE");
}

inline void bind_quiet(CLI::App& command, bool& quiet,
                       const char* help = "No progress, no summary; warnings and errors only") {
  command.add_flag("--quiet", quiet, help);
}

inline void bind_white(CLI::App& command, std::string& white, const char* help) {
  command.add_option("--white", white, help)
      ->capture_default_str()
      ->check(one_of({"D65", "illuminant"}))
      ->type_name("NAME");
}

template <typename Arguments>
CLI::App* add_command(CLI::App& app, const char* name, const char* description, std::function<int()>& action,
                      int (*run)(const Arguments&), std::shared_ptr<Arguments> arguments) {
  CLI::App* command = app.add_subcommand(name, description);
  command->callback([&action, run, arguments] { action = [run, arguments] { return run(*arguments); }; });
  return command;
}

/// `photopic optimize` and `photopic compare`, bound in files of their own.
void bind_optimize(CLI::App& app, std::function<int()>& action, int& threads);
void bind_compare(CLI::App& app, std::function<int()>& action, int& threads);

}  // namespace photopic
