#include "reports/challenge_sheet.hpp"

#include <fmt/format.h>

namespace xpr {
namespace {

std::string parameters_text(const ChallengeSet& set) {
  std::string text;
  for (const NamedValue& p : set.parameters)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", p.name, p.value);
  return text.empty() ? "no parameters" : text;
}

/// A row of a Markdown table; a | in it does not end the cell.
std::string line(std::string_view what, std::string_view says) {
  std::string text = fmt::format("| {} | ", what);
  for (const char c : says) text += c == '|' ? "\\|" : std::string(1, c);
  return text + " |\n";
}

bool has_azimuth(const Card& card) { return card.coordinates[3].kind == CoordinateKind::azimuth; }

std::string radius_text(const ChallengeSet& set) {
  if (set.metric == "ellis") return "r = sqrt(l^2 + b0^2), on either side of the throat";
  if (set.metric == "kerr") return "r is Boyer-Lindquist's, in every chart";
  if (set.metric == "schwarzschild") return "r is the areal radius, in every chart";
  return "r = |x|";
}

std::string unit_text(const ChallengeSet& set) {
  if (set.parameters.empty()) return "G = c = 1; lengths in any one unit";
  return fmt::format("G = c = 1; lengths in units of {}", set.parameters.front().name);
}

std::string orientation_text(const ChallengeSet& set, const Card& card) {
  std::string text = has_azimuth(card) ? "phi grows from x to y, right-handed about z (theta = 0)"
                                       : "x, y, z right-handed, phi = atan2(y, x)";
  if (set.metric == "kerr") {
    text += "; the hole turns towards growing phi for a > 0: g_tphi < 0, prograde light has p_phi > 0 (p_t < 0)";
  }
  return text;
}

std::string conventions_table(const ChallengeSet& set, const Spacetime& chart) {
  const Card& card = chart.card();
  std::string text = "| what | convention |\n| --- | --- |\n";
  text += line("spacetime", fmt::format("`{}`, {}", set.metric, parameters_text(set)));
  text += line("chart", fmt::format("`{}`: x0..x3 = {}, {}, {}, {}; {}", card.chart, card.coordinates[0].name,
                                    card.coordinates[1].name, card.coordinates[2].name, card.coordinates[3].name,
                                    card.line_element));
  text += line("units", unit_text(set));
  text += line("signature", "(- + + +)");
  text += line("p0..p3", "covariant, p_mu with a lower index; light: g^{mu nu} p_mu p_nu = 0");
  text += line("direction in time",
               "p_t < 0: along the light; p_t > 0: traced back in time, as a camera does. Rays go "
               "along p either way");
  text += line("energy", "E = |p_t| is 1, and 2 for some: dx^mu/dlambda = g^{mu nu} p_nu, so lambda follows");
  text += line("lambda", "0 at the start, growing along p, whichever way that is in time");
  text += line("orientation", orientation_text(set, card));
  if (has_azimuth(card)) {
    text += line("theta", "from the axis, radians, in [0, pi]; one that leaves this range counts as an axis crossed");
    text += line("phi",
                 "radians, continuous along the ray: it starts in (-pi, pi) and counts its turns. A ray through "
                 "the axis goes on with phi + pi");
  }
  text += line("where to stop",
               fmt::format("going outward at r = {:g}{}: escaped{}", set.r_max, fmt::format(" ({})", radius_text(set)),
                           set.captures ? ", going inward just outside the horizon: captured" : ""));
  text += line("which step to hand in",
               "any: the last before the stop, the first after it or one in between. Each ray is "
               "compared with the exact one at the radius that is handed in");
  return text;
}

}  // namespace

std::string trace_command(const ChallengeSet& set, const std::string& chart, const std::string& in,
                          const std::string& out) {
  std::string text = fmt::format("xprimeray trace --metric {}", set.metric);
  for (const NamedValue& p : set.parameters) text += fmt::format(" --set {}={}", p.name, p.value);
  return text + fmt::format(" --chart {} --method dop853 --tol 1e-12 --r-max {:g} --rays {} --out {}", chart, set.r_max,
                            in, out);
}

std::string convention_sheet(const ChallengeSet& set, const std::string& chart, std::int64_t count,
                             const std::string& table) {
  const auto spacetime = set.spacetime(chart);
  std::string text = fmt::format("# Challenge set `{}`\n\n{}.\n\n{} rays, ids {} to {}, in `{}`.\n\n## Conventions\n\n",
                                 set.id, set.title, count, set.first_id, set.first_id + count - 1, table);
  text += conventions_table(set, *spacetime);
  text +=
      "\n## What to hand in\n\nA table, `.csv` or `.h5`, with one row for each ray, in any order:\n\n"
      "| column | |\n| --- | --- |\n"
      "| `id` | needed |\n"
      "| `x0` ... `x3` | needed: where the ray ended. `nan` for a ray that could not be traced: it counts as failed |\n"
      "| `p0` ... `p3` | graded where they are there: heading, conserved quantities, null residual |\n"
      "| `status` | `escaped`, `captured`; or why it is neither: `max_steps`, `max_affine`, `step_underflow`, "
      "`not_finite`, `constraint_violated`, `outside_domain`. Without it, read off the radius |\n"
      "| `lambda` | graded where it is there |\n"
      "| `steps`, `rejected`, `evaluations`, `seconds` | work, of which the first that is there counts |\n";
  if (set.metric == "ellis") text += "| `sheet` | in isotropic coordinates: +1 near side, -1 far side |\n";
  const std::string option = chart == set.home_chart ? "" : " --chart " + chart;
  text += fmt::format("\n    xprimeray grade score --set {}{}{} --rays mine.csv --out card/\n", set.id, option,
                      count == set.usual_rays ? "" : fmt::format(" --count {}", count));
  text += fmt::format("\nThis program's own rays, to compare with:\n\n    {}\n",
                      trace_command(set, chart, table, "mine.csv"));
  text += "\n## The rays\n\n| family | |\n| --- | --- |\n";
  for (const RayFamily& family : set.families) text += line(family.name, family.what);
  text += fmt::format("\nRay k (from 0) belongs to family k modulo {}.\n", set.families.size());
  return text;
}

}  // namespace xpr
