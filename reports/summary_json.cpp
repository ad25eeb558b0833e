#include "reports/summary_json.hpp"

#include "core/io/json.hpp"
#include "reports/report.hpp"

namespace xpr {
namespace {

Json counts_json(const Counts& counts) {
  return {{"pass", counts.pass},   {"fail", counts.fail},       {"inconclusive", counts.inconclusive},
          {"error", counts.error}, {"skipped", counts.skipped}, {"total", counts.total()}};
}

Json row_json(const RowOfCase& at) {
  const Row& row = *at.row;
  const auto measure = [&row](double value) { return measured(row) ? json_number(value) : Json(nullptr); };
  return {{"case", at.result->info.id},
          {"row", row.label},
          {"metric", row.metric},
          {"chart", row.chart},
          {"method", row.method},
          {"value", measure(row.value)},
          {"reference", measure(row.reference)},
          {"reference_error", measure(row.reference_error)},
          {"error", measure(row.error)},
          {"tolerance", measure(row.tolerance)},
          {"error_over_tolerance", measure(error_over_tolerance(row))},
          {"unit", row.unit},
          {"verdict", to_string(row.verdict)},
          {"note", row.note}};
}

Json rows_json(const std::vector<RowOfCase>& rows) {
  Json list = Json::array();
  for (const RowOfCase& at : rows) list.push_back(row_json(at));
  return list;
}

Json families_json(const Digest& digest) {
  Json families = Json::object();
  for (const FamilyDigest& family : digest.families) {
    Json cases = Json::object();
    for (const CaseDigest& one : family.cases) {
      cases[one.result->info.id] = {{"counts", counts_json(one.counts)},
                                    {"rank", to_string(one.result->info.rank)},
                                    {"error_over_tolerance",
                                     {{"rows", one.tail.rows},
                                      {"median", json_number(one.tail.median)},
                                      {"p99", json_number(one.tail.p99)},
                                      {"max", json_number(one.tail.max)}}}};
    }
    families[family.name] = {{"counts", counts_json(family.counts)},
                             {"worst_error_over_tolerance", json_number(family.tail.max)},
                             {"cases", std::move(cases)}};
  }
  return families;
}

Json faults_json(const SuiteResult& suite, const Digest& digest) {
  Json missed = Json::array();
  for (const FaultResult* fault : digest.missed_faults) missed.push_back(fault->id);
  return {{"planted", suite.faults.size()},
          {"caught", suite.faults.size() - digest.missed_faults.size()},
          {"missed", std::move(missed)}};
}

}  // namespace

std::string summary_json(const Contents& contents) {
  const Digest& digest = contents.digest;
  Json figures = Json::array();
  for (const Picture& picture : contents.figures.drawn) figures.push_back(picture.file);
  Json provenance = Json::object();
  for (const auto& [name, text] : contents.provenance) provenance[name] = text;
  const Json summary = {{"schema", "xprimeray-report-summary"},
                        {"schema_version", report_schema_version},
                        {"suite", contents.suite.suite},
                        {"outcome", to_string(digest.outcome)},
                        {"verdict", digest.sentence},
                        {"exit_code", exit_code(contents.suite)},
                        {"counts", counts_json(digest.counts)},
                        {"faults", faults_json(contents.suite, digest)},
                        {"report_hash", contents.hashes.report},
                        {"rays_hash", contents.hashes.rays},
                        {"families", families_json(digest)},
                        {"failures", rows_json(digest.failures)},
                        {"skipped", rows_json(digest.skipped)},
                        {"worst", rows_json(digest.worst)},
                        {"figures", std::move(figures)},
                        {"figure_problems", contents.figures.problems},
                        {"command", contents.command},
                        {"provenance", std::move(provenance)}};
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace xpr
