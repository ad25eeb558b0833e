// xprimeray: one program, subcommands in the manner of git. Here the command line is read, one subcommand run, and
// whatever it throws turned into one line on standard error and an exit code:
//   0 all well, 1 something graded failed, 2 bad usage or input, 3 a fault while running, 4 truth inconclusive,
//   130 interrupted.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "command.hpp"
#include "core/io/errors.hpp"
#include "core/io/provenance.hpp"

namespace xpr::cli {
namespace {

constexpr int bad_usage = 2;
constexpr int fault = 3;
constexpr int was_interrupted = 130;

int complain(int exit_code, std::string_view message) {
  fmt::print(stderr, "xprimeray: {}\n", message);
  return exit_code;
}

// The nearest subcommand or option to a word that nothing expects.
std::string unexpected(const CLI::App& program, const std::string& word) {
  std::vector<std::string_view> known;
  std::vector<std::string> spelled;
  for (const CLI::App* command : program.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) spelled.push_back("--" + name);
    }
    known.assign(spelled.begin(), spelled.end());
    if (!word.starts_with("-")) return fmt::format("{}: unexpected argument '{}'", command->get_name(), word);
    return command->get_name() + ": " + unknown_name("option", word.substr(0, word.find('=')), known);
  }
  const auto all = [](const CLI::App*) { return true; };
  for (const CLI::App* command : program.get_subcommands(all)) spelled.push_back(command->get_name());
  known.assign(spelled.begin(), spelled.end());
  return unknown_name("subcommand", word, known);
}

int run_chosen(const std::vector<Command>& commands) {
  const auto chosen = std::find_if(commands.begin(), commands.end(), [](const Command& c) { return c.app->parsed(); });
  const int exit_code = chosen->run();
  if (std::fflush(stdout) != 0) throw FaultError("standard output cannot be written");
  return exit_code;
}

int guarded(const std::function<int()>& action) {
  try {
    return action();
  } catch (const Interrupted&) {
    return complain(was_interrupted, "interrupted; nothing was written");
  } catch (const InputError& error) {
    return complain(bad_usage, error.what());
  } catch (const std::invalid_argument& error) {
    return complain(bad_usage, error.what());
  } catch (const std::exception& error) {
    return complain(fault, error.what());
  }
}

int parse_and_run(int argc, char** argv) {
  CLI::App program("How wrong is a ray tracer, and can you prove it? Null geodesics, graded.", "xprimeray");
  program.set_version_flag("--version", [] { return "xprimeray " + provenance().version; });
  program.require_subcommand(1);
  program.footer("Each subcommand has its own --help with an example.\nExample:\n  xprimeray explain kerr");
  const std::vector<Command> commands{register_validate(program),  register_sweep(program),   register_trace(program),
                                      register_conform(program),   register_list(program),    register_explain(program),
                                      register_errormap(program),  register_grade(program),   register_paper(program),
                                      register_repro(program),     register_compare(program), register_render(program),
                                      register_reference(program), register_doctor(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return program.exit(asked);  // --help, --version
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> left = program.remaining(true);
    if (!left.empty()) return complain(bad_usage, unexpected(program, left.front()));
    const std::string line = error.what();
    return complain(bad_usage, line.substr(0, line.find('\n')) + "; see xprimeray --help");
  }
  return guarded([&] { return run_chosen(commands); });
}

}  // namespace
}  // namespace xpr::cli

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error to report, not a reason to vanish
  return xpr::cli::guarded([&] { return xpr::cli::parse_and_run(argc, argv); });
}
