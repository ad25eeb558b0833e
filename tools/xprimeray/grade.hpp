// What the subcommands of `xprimeray grade` share.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "validation/grading/challenge.hpp"

namespace xpr::cli {

struct GradeOptions {
  OutputFlags output;
  std::string set;
  std::string chart;
  std::int64_t count = 0;  ///< 0: the usual number
  std::string out;
  std::string name;
  std::vector<std::string> rays;
};

/// --set, --count and --chart, checked. Throw InputError or std::invalid_argument.
[[nodiscard]] const ChallengeSet& set_for(const GradeOptions& options);
[[nodiscard]] std::int64_t count_for(const GradeOptions& options, const ChallengeSet& set);
[[nodiscard]] std::string chart_for(const GradeOptions& options, const ChallengeSet& set);

/// Writes a set's rays, FILE.sheet.md and FILE.meta.json. False where the path is a pipe, which gets the rays alone.
bool write_challenge(const ChallengeSet& set, const std::string& chart, std::int64_t count, const std::string& path);

/// A table to grade, and the tolerance at which it was made (NaN: not said).
struct GradedTable {
  std::string file;
  double tolerance;
};

struct CardRequest {
  std::vector<GradedTable> tables;
  std::string chart;
  std::int64_t count = 0;
  std::string name;
  std::string command;
  std::vector<std::string> notes = {};
};

/// Grades tables, writes the card, says what came of it. The exit code: 1 where the grade is F.
[[nodiscard]] int grade_tables(const GradeOptions& options, const ChallengeSet& set, const CardRequest& request);

/// Another code that this program can run: an adapter in tools/peers and what it takes.
struct PeerCard {
  std::string_view id;
  std::string_view name;
  std::string_view script;
  std::string_view what;
  std::string_view tol_text;  ///< what --tol is to it
  std::vector<double> usual_tol;
  std::string_view integrator_text;
  std::string_view usual_integrator;
  std::int64_t usual_rays;  ///< 0: the set's
  std::string_view note;    ///< for its card
  std::string_view example;
};

struct PeerOptions {
  GradeOptions base;
  std::vector<double> tol;
  std::string integrator;
};

[[nodiscard]] const std::vector<PeerCard>& peers();

/// Runs a peer on a set and grades it. Where it is not installed it says so loudly and returns 0. Throws FaultError
/// where the peer fails.
[[nodiscard]] int run_peer(const PeerCard& peer, const PeerOptions& options);

}  // namespace xpr::cli
