#include "reports/figures.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <utility>

#include "reports/text.hpp"

namespace xpr {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view no_figures = "NO FIGURES: ";

/// Runs the script with its output in `log`. Empty where it ended well, else the reason.
std::string run_script(const FigureTools& tools, const fs::path& data, const fs::path& folder, const fs::path& log) {
  std::array<std::string, 5> words = {tools.python.string(), "-B", tools.script.string(), data.string(),
                                      folder.string()};
  std::array<char*, 6> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = -1;
  const int failed = posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return fmt::format("{} cannot be run: {}", words[0], std::strerror(failed));
  const auto deadline = std::chrono::steady_clock::now() + tools.limit;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return fmt::format("the script took longer than {} s and was stopped", tools.limit.count());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (WIFSIGNALED(status)) return fmt::format("the script was ended by signal {}", WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("the script ended with status {}", WEXITSTATUS(status));
}

/// The last line of a log that says something: with Python, the exception.
std::string last_line(const fs::path& log) {
  std::ifstream in(log);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  return clean_text(last);
}

/// Reads the index; throws what its parser or its lookups throw where it is not as agreed.
FigureSet read_index(const fs::path& folder) {
  FigureSet figures;
  std::ifstream in(folder / "index.json");
  const nlohmann::json index = nlohmann::json::parse(in);
  for (const nlohmann::json& figure : index.at("figures")) {
    const auto name = figure.at("name").get<std::string>();
    if (!fs::exists(folder / (name + ".svg")) || !fs::exists(folder / (name + ".png"))) {
      figures.problems.push_back("A FIGURE IS MISSING: " + name + " is in the index and was not written.");
      continue;
    }
    figures.drawn.push_back(
        {"figures/" + name, figure.at("title").get<std::string>(), figure.at("caption").get<std::string>()});
  }
  for (const nlohmann::json& problem : index.at("problems")) {
    figures.problems.push_back("A FIGURE IS MISSING: " + problem.get<std::string>());
  }
  return figures;
}

std::string missing_tool(const FigureTools& tools) {
  if (tools.python.empty()) {
    return "no Python with h5py and matplotlib was found (Debian packages python3-h5py, python3-matplotlib)";
  }
  std::error_code error;
  return fs::exists(tools.script, error) ? "" : fmt::format("the script {} is not there", tools.script.string());
}

fs::path program_directory() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path();
}

}  // namespace

FigureTools found_figure_tools(const std::string& script_name) {
  FigureTools tools;
  tools.python = XPR_PYTHON;
  tools.script = fs::path(XPR_FIGURE_SCRIPTS) / script_name;
  std::error_code error;
  if (!fs::exists(tools.script, error)) {
    tools.script = program_directory().parent_path() / "share/xprimeray/figures" / script_name;
  }
  if (const char* python = std::getenv("XPRIMERAY_PYTHON")) tools.python = python;
  if (const char* script = std::getenv("XPRIMERAY_FIGURE_SCRIPT")) tools.script = script;
  return tools;
}

FigureSet draw_figures(const FigureTools& tools, const fs::path& directory, const std::string& data) {
  FigureSet figures;
  std::string reason = missing_tool(tools);
  const fs::path folder = directory / "figures";
  const fs::path log = directory / "figures.log";
  if (reason.empty()) {
    reason = run_script(tools, directory / data, folder, log);
    if (reason.empty()) {
      try {
        figures = read_index(folder);
      } catch (const std::exception& error) {
        reason = fmt::format("the index of the figures cannot be read: {}", clean_text(error.what()));
      }
    } else if (const std::string said = last_line(log); !said.empty()) {
      reason += ": " + said;
    }
  }
  std::error_code ignored;
  fs::remove(log, ignored);
  if (!reason.empty()) {
    fs::remove_all(folder, ignored);
    figures = {};
    figures.problems = {fmt::format("{}{}. All numbers are in {}.", no_figures, reason, data)};
  }
  return figures;
}

}  // namespace xpr
