// xprimeray explain: the physics, the formula and the source behind a case, a metric, a method or a planted fault.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "command.hpp"
#include "core/io/errors.hpp"
#include "integrators/stepper.hpp"
#include "metrics/catalogue.hpp"
#include "validation/case.hpp"

namespace xpr::cli {
namespace {

void print_field(std::string_view name, std::string_view text) {
  if (!text.empty()) fmt::print("{}: {}\n", name, text);
}

void print_cites(std::string_view cites) {
  if (!cites.empty()) fmt::print("cites: {} (reference_data/references.bib)\n", cites);
}

void explain_chart(const CatalogueEntry& entry) {
  const Card& card = *entry.card;
  fmt::print("\nchart {}: {}\n", card.chart, card.title);
  fmt::print("  {}\n  coordinates:", card.line_element);
  for (const Coordinate& c : card.coordinates) {
    fmt::print(" {}", c.name);
    if (c.lower > -unbounded || c.upper < unbounded) fmt::print(" in ({:.5g}, {:.5g})", c.lower, c.upper);
  }
  fmt::print("\n");
}

bool explain_metric(const std::string& id) {
  bool first = true;
  for (const CatalogueEntry& entry : catalogue()) {
    if (entry.card->metric != id) continue;
    if (first) {
      fmt::print("metric {}\n", id);
      for (const ParameterCard& p : entry.parameters) {
        fmt::print("  --set {}={}: {}\n", p.name, p.fallback, p.meaning);
      }
      const auto spacetime = make_spacetime(id, "");
      if (const auto horizon = spacetime->horizon_radius()) {
        fmt::print("  horizon at r = {:.17g}, default --r-min {:.17g} (for these parameters)\n", *horizon,
                   spacetime->default_r_min().value_or(*horizon));
      }
      fmt::print("  {}; {}\n", entry.card->vacuum ? "vacuum" : "not vacuum",
                 entry.card->asymptotically_flat ? "asymptotically flat" : "not asymptotically flat");
      fmt::print("  transport runs in {} (p^t > 0) or {} (p^t < 0) unless --transport-chart says otherwise\n",
                 transport_chart(id, true), transport_chart(id, false));
    }
    first = false;
    explain_chart(entry);
    fmt::print("  ");
    print_cites(entry.card->cites);
  }
  return !first;
}

bool explain_method(const std::string& id) {
  const auto found = std::find_if(methods().begin(), methods().end(), [&](const MethodCard& m) { return m.id == id; });
  if (found == methods().end()) return false;
  fmt::print("method {}: {}\n", id, found->title);
  fmt::print("  order {}, dense output of order {}\n", found->order, found->dense_order);
  fmt::print("  {}\n", found->adaptive ? "adaptive: --tol" : "fixed step: --step, in lambda for |p_t| = 1");
  if (found->symplectic) fmt::print("  symplectic{}\n", id.starts_with("tao") ? " in the doubled phase space" : "");
  if (found->separable_only) fmt::print("  for Hamiltonians that separate, T(p) + V(x): flat space and static media\n");
  return true;
}

std::string_view meaning_of(TruthRank rank) {
  switch (rank) {
    case TruthRank::closed_form:
      return "a closed form";
    case TruthRank::high_precision:
      return "an independent computation to high precision";
    case TruthRank::published_table:
      return "a published table";
    case TruthRank::digitised_plot:
      return "a digitised plot";
    case TruthRank::same_source:
      return "our own metric at 50 digits, which grades steppers only";
    case TruthRank::self_convergence:
      return "self-convergence, which never turns a case green alone";
  }
  return {};
}

bool explain_case(const std::string& id) {
  const auto found = std::find_if(cases().begin(), cases().end(), [&](const Case& c) { return c.info.id == id; });
  if (found == cases().end()) return false;
  const CaseInfo& info = found->info;
  fmt::print("case {}\n", id);
  print_field("claim", info.claim);
  print_field("physics", info.physics);
  print_field("truth", info.truth);
  print_field("rank of the truth", meaning_of(info.rank));
  print_field("grades", info.grades_metric ? "a metric" : "a stepper or the harness");
  print_field("suites", found->quick ? "quick, full" : "full");
  for (const Fault& fault : faults()) {
    if (fault.case_id == id) fmt::print("must catch: {}: {}\n", fault.id, fault.description);
  }
  print_cites(info.cites);
  print_field("source", info.source);
  return true;
}

bool explain_fault(const std::string& id) {
  const auto found = std::find_if(faults().begin(), faults().end(), [&](const Fault& f) { return f.id == id; });
  if (found == faults().end()) return false;
  fmt::print("planted fault {}\n", id);
  print_field("what is wrong", found->description);
  print_field("caught by", found->case_id);
  fmt::print("run it with: xprimeray validate --self-test\n");
  return true;
}

int run_explain(const std::string& id) {
  if (explain_case(id) || explain_metric(id) || explain_method(id) || explain_fault(id)) return 0;
  std::vector<std::string_view> known;
  for (const CatalogueEntry& entry : catalogue()) known.push_back(entry.card->metric);
  for (const MethodCard& method : methods()) known.push_back(method.id);
  for (const Case& c : cases()) known.push_back(c.info.id);
  for (const Fault& fault : faults()) known.push_back(fault.id);
  const std::string near = nearest_name(id, known);
  throw InputError(fmt::format("unknown id '{}'; {}", id,
                               near.empty() ? "see xprimeray list" : fmt::format("did you mean '{}'?", near)));
}

}  // namespace

Command register_explain(CLI::App& program) {
  CLI::App* app = program.add_subcommand("explain", "Physics, formula and source behind a case, metric or method");
  const auto id = std::make_shared<std::string>();
  app->add_option("id", *id, "As in `xprimeray list`")->required();
  add_example(*app, "  xprimeray explain kerr");
  return {app, [id] { return run_explain(*id); }};
}

}  // namespace xpr::cli
