// xprimeray grade gyoto | einsteinpy: runs the other code where it is installed, and grades it.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/io/errors.hpp"
#include "grade.hpp"
#include "reports/card_report.hpp"
#include "reports/figures.hpp"

namespace xpr::cli {
namespace {

namespace fs = std::filesystem;

/// Exit code of an adapter whose code is not there.
constexpr int not_installed = 4;

/// A directory of its own, gone at the end.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "xprimeray-grade-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw_system_error(name, "cannot be created", errno);
    path_ = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

struct Finished {
  int exit_code = 0;
  std::string said;  ///< the last line on its standard error
};

std::string last_line(const fs::path& log) {
  std::ifstream in(log);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  return last;
}

/// Runs a program to its end. Its standard output goes nowhere, its standard error to the terminal's if that is one.
Finished run_program(std::vector<std::string> words, const fs::path& log) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = -1;
  const int failed = posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw InputError(fmt::format("{} cannot be run: {}", words[0], std::strerror(failed)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status)) return {128 + WTERMSIG(status), fmt::format("ended by signal {}", WTERMSIG(status))};
  return {WEXITSTATUS(status), last_line(log)};
}

/// The adapter of the source tree of the build, else in share/xprimeray/peers beside the running program.
fs::path adapter_script(const std::string& name) {
  std::error_code error;
  if (const char* folder = std::getenv("XPRIMERAY_PEERS")) return fs::path(folder) / name;
  fs::path script = fs::path(XPR_PEER_SCRIPTS) / name;
  if (fs::exists(script, error)) return script;
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "share/xprimeray/peers" / name;
}

}  // namespace

const std::vector<PeerCard>& peers() {
  static const std::vector<PeerCard> all{
      {.id = "gyoto",
       .name = "GYOTO",
       .script = "gyoto_rays.py",
       .what = "Run GYOTO on a set and grade it, where it is installed",
       .tol_text = "AbsTol = RelTol, several by commas (default: 1e-6,1e-8,1e-10,1e-12)",
       .usual_tol = {1e-6, 1e-8, 1e-10, 1e-12},
       .integrator_text = "runge_kutta_fehlberg78 (default), runge_kutta_cash_karp54, runge_kutta_dopri5, "
                          "runge_kutta_cash_karp54_classic or Legacy",
       .usual_integrator = "runge_kutta_fehlberg78",
       .usual_rays = 0,
       .note =
           "GYOTO's own steps are handed in: the first beyond r_max, or the last before it stops at the horizon. Its "
           "adapter (tools/peers/gyoto_rays.py) makes phi continuous, lowers p with GYOTO's metric and turns light "
           "that is traced back in time round; nothing else is changed.",
       .example = "  xprimeray grade gyoto --set kerr-core --out card/\n"
                  "  xprimeray grade gyoto --set kerr-core --chart kerr-schild --tol 1e-9 --out card/"},
      {.id = "einsteinpy",
       .name = "EinsteinPy",
       .script = "einsteinpy_rays.py",
       .what = "Run EinsteinPy's geodesic integrator on a set and grade it, where it is installed",
       .tol_text = "its fixed steps in lambda, several by commas (default: 1,0.25)",
       .usual_tol = {1.0, 0.25},
       .integrator_text = "order of the FANTASY integrator: 2, 4 (default), 6 or 8",
       .usual_integrator = "4",
       .usual_rays = 12,
       .note =
           "EinsteinPy steps with a fixed length, given here in the place of a tolerance; its adapter "
           "(tools/peers/einsteinpy_rays.py) stops each ray beyond r_max, next to the horizon, or after 2000 steps.",
       .example = "  xprimeray grade einsteinpy --set schwarzschild-core --out card/"}};
  return all;
}

int run_peer(const PeerCard& peer, const PeerOptions& options) {
  const GradeOptions& base = options.base;
  const ChallengeSet& set = set_for(base);
  if (base.out.empty()) throw InputError(fmt::format("grade {}: --out is missing, a directory", peer.id));
  for (const double tol : options.tol) {
    if (!(tol > 0.0)) throw InputError(fmt::format("grade {}: --tol {}, needs more than 0", peer.id, tol));
  }
  check_card_directory(base.out);
  GradeOptions wanted = base;
  if (wanted.count == 0) wanted.count = peer.usual_rays;
  CardRequest request;
  request.count = count_for(wanted, set);
  request.chart = chart_for(wanted, set);
  const Scratch scratch;
  const fs::path challenge = scratch / "challenge.csv";
  write_challenge(set, request.chart, request.count, challenge.string());
  const fs::path python = found_figure_tools().python;
  std::vector<std::string> words{python.empty() ? "python3" : python.string(),
                                 "-B",
                                 adapter_script(std::string(peer.script)).string(),
                                 challenge.string(),
                                 scratch.path().string(),
                                 "--tol"};
  const std::vector<double>& tolerances = options.tol.empty() ? peer.usual_tol : options.tol;
  for (const double tol : tolerances) words.push_back(fmt::format("{:g}", tol));
  const std::string integrator = options.integrator.empty() ? std::string(peer.usual_integrator) : options.integrator;
  words.push_back("--integrator");
  words.push_back(integrator);
  const Finished finished = run_program(words, scratch / "log");
  if (finished.exit_code == not_installed) {
    fmt::print("SKIPPED: {} was not graded. {}\n", peer.name, finished.said);
    return 0;
  }
  if (finished.exit_code == 130) throw Interrupted("interrupted");
  if (finished.exit_code == 2) throw InputError(fmt::format("grade {}: {}", peer.id, finished.said));
  if (finished.exit_code != 0) {
    throw FaultError(fmt::format("grade {}: exit code {}: {}", peer.id, finished.exit_code, finished.said));
  }
  for (const double tol : tolerances) {
    request.tables.push_back({(scratch / fmt::format("rays-{:g}.csv", tol)).string(), tol});
  }
  request.name = base.name.empty() ? fmt::format("{}, {}", peer.name, integrator) : base.name;
  request.command = fmt::format("xprimeray grade {} --set {} --chart {} --count {} --integrator {} --tol {}", peer.id,
                                set.id, request.chart, request.count, integrator, fmt::join(tolerances, ","));
  request.notes = {std::string(peer.note)};
  return grade_tables(base, set, request);
}

}  // namespace xpr::cli
