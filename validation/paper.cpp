#include "validation/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/io/csv.hpp"
#include "core/io/hash.hpp"
#include "metrics/catalogue.hpp"
#include "metrics/scalar/elementary.hpp"

namespace xpr {

namespace {

/// Worst first.
constexpr std::array worst_first{Verdict::error, Verdict::fail, Verdict::inconclusive, Verdict::pass, Verdict::skipped};

Row new_row(const Claim& claim, const std::string& route) {
  Row row;
  row.label = fmt::format("{}: {}", claim.quantity, route);
  row.unit = claim.unit;
  return row;
}

std::string source_file(std::string_view id) {
  std::string name(id);
  std::replace(name.begin(), name.end(), '-', '_');
  return fmt::format("validation/papers/{}.cpp", name);
}

}  // namespace

std::vector<double> even_steps(double first, double last, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(first + (last - first) * i / (count - 1));
  return out;
}

std::vector<double> log_steps(double first, double last, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(first * std::pow(last / first, static_cast<double>(i) / (count - 1)));
  return out;
}

Verdict verdict_of(const Claim& claim) {
  for (const Verdict verdict : worst_first) {
    if (std::any_of(claim.rows.begin(), claim.rows.end(), [&](const Row& row) { return row.verdict == verdict; })) {
      return verdict;
    }
  }
  return Verdict::error;
}

Counts count_claims(const PaperResult& result) {
  CaseResult each;
  for (const Claim& claim : result.claims) {
    each.rows.emplace_back();
    each.rows.back().verdict = verdict_of(claim);
  }
  return count(each);
}

PrintedNumber printed_number(std::string_view text) {
  double value = 0.0;
  if (parse_number(text, value) != NumberFault::none) {
    throw std::invalid_argument(fmt::format("printed number '{}' is no number", text));
  }
  const std::size_t exponent_at = std::min(text.find_first_of("eE"), text.size());
  const std::string_view mantissa = text.substr(0, exponent_at);
  const std::size_t point = mantissa.find('.');
  const double decimals = point == std::string_view::npos ? 0.0 : static_cast<double>(mantissa.size() - point - 1);
  double exponent = 0.0;
  if (exponent_at < text.size() && parse_number(text.substr(exponent_at + 1), exponent) != NumberFault::none) {
    throw std::invalid_argument(fmt::format("printed number '{}' has no exponent", text));
  }
  return {value, 0.5 * std::pow(10.0, exponent - decimals)};
}

ClaimSheet& ClaimSheet::add(Row row, double value, const Tolerance& tolerance) {
  grade(row, value, {claim().exact.value, claim().exact.error}, tolerance);
  claim().rows.push_back(std::move(row));
  return *this;
}

ClaimSheet& ClaimSheet::exact(const ExactValue& value, std::string by) {
  claim().exact = value;
  claim().exact_by = std::move(by);
  return *this;
}

ClaimSheet& ClaimSheet::printed(std::string text, std::string source, double half_units) {
  const PrintedNumber number = printed_number(text);
  Row row = new_row(claim(), "as printed");
  row.note = "printed: " + source;
  // The allowance is for a printed number that stands exactly half a unit off.
  add(std::move(row), number.value,
      {half_units * number.half_unit * (1.0 + 1e-9),
       half_units > 1.0 ? "a unit of the last printed digit: cut off" : "half a unit of the last printed digit"});
  claim().printed = std::move(text);
  claim().printed_source = std::move(source);
  return *this;
}

ClaimSheet& ClaimSheet::misprinted(std::string text, std::string source) {
  const PrintedNumber number = printed_number(text);
  const double off = std::abs(number.value - claim().exact.value);
  Row row = new_row(claim(), "as printed, found wrong");
  row.note = fmt::format("printed: {}; off by {:.3g}, {:.3g} units of its last digit: see the findings", source, off,
                         off / (2.0 * number.half_unit));
  row.unit = "1";
  grade_bound(row, (number.half_unit + claim().exact.error) / off,
              {1.0, "half the last printed digit over the distance from the exact number: above 1, nothing is wrong"});
  claim().rows.push_back(std::move(row));
  claim().printed = std::move(text);
  claim().printed_source = std::move(source);
  claim().misprint = true;
  return *this;
}

ClaimSheet& ClaimSheet::not_established(std::string text, std::string why) {
  claim().rows.push_back(skipped_row(claim().quantity + ": as printed, from memory",
                                     fmt::format("not established: {}; {}", text, why), claim().unit));
  claim().printed_source = std::move(text);
  return *this;
}

ClaimSheet& ClaimSheet::ours(std::string route, double value, const Tolerance& tolerance) {
  return add(new_row(claim(), route), value, tolerance);
}

ClaimSheet& ClaimSheet::traced(const TracedRoute& route, double value, const Tolerance& tolerance) {
  const std::string name = fmt::format("{} at {:g} in {}{}{}", method_label(route.method), route.method.setting,
                                       route.chart.card().chart, route.where.empty() ? "" : ", ", route.where);
  Row row = make_row(fmt::format("{}: {}", claim().quantity, name), route.chart, route.method, {});
  row.unit = claim().unit;
  if (ended_as(row, route.end, route.wanted)) return add(std::move(row), value, tolerance);
  claim().rows.push_back(std::move(row));
  return *this;
}

ClaimSheet& ClaimSheet::from_rays(std::string route, const Spacetime& chart, const MethodAt& method, double value,
                                  const Tolerance& tolerance) {
  const std::string name =
      fmt::format("{}, {} at {:g} in {}", route, method_label(method), method.setting, chart.card().chart);
  Row row = make_row(fmt::format("{}: {}", claim().quantity, name), chart, method, {});
  row.unit = claim().unit;
  return add(std::move(row), value, tolerance);
}

ClaimSheet& ClaimSheet::wrong_formula(std::string route, double value, double least, std::string reason) {
  const double off = std::abs(value - claim().exact.value);
  Row row = new_row(claim(), route);
  row.unit = "1";
  row.note = fmt::format("gives {:.10g}, off by {:.3g}: see the findings", value, off);
  grade_bound(row, least / off, {1.0, std::move(reason)});
  claim().rows.push_back(std::move(row));
  return *this;
}

ClaimSheet PaperSheet::claim(std::string quantity, std::string unit) {
  result_->claims.emplace_back();
  result_->claims.back().quantity = std::move(quantity);
  result_->claims.back().unit = std::move(unit);
  return {*result_, result_->claims.size() - 1};
}

const Paper& find_paper(std::string_view id) {
  std::vector<std::string_view> known;
  for (const Paper& paper : all_papers()) {
    if (paper.info.id == id) return paper;
    known.push_back(paper.info.id);
  }
  const std::string near = nearest_name(id, known);
  throw std::invalid_argument(
      fmt::format("unknown paper '{}'; {}", id,
                  near.empty() ? "see xprimeray paper --list" : fmt::format("did you mean '{}'?", near)));
}

PaperResult run_paper(const Paper& paper, const Lab& lab) {
  PaperResult result;
  result.info = paper.info;
  CanonicalHash transported;
  const auto begin = std::chrono::steady_clock::now();
  try {
    const Lab recorded = lab.recording(transported.dataset("rays"));
    PaperSheet sheet(recorded, result);
    paper.run(sheet);
  } catch (const std::exception& problem) {
    Claim broken;
    broken.quantity = "run";
    broken.rows.push_back(new_row(broken, "exception"));
    broken.rows.back().note = fmt::format("exception: {}", problem.what());
    result.claims.push_back(std::move(broken));
  }
  result.transported = transported.hex();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

namespace {

CaseInfo case_info(const PaperInfo& info) {
  return {.id = "papers/" + info.id,
          .family = "papers",
          .claim = info.reproduced,
          .physics = info.reference,
          .truth = "closed forms and quadrature, against the numbers as printed",
          .rank = TruthRank::closed_form,
          .grades_metric = true,
          .cites = info.cites,
          .source = source_file(info.id)};
}

}  // namespace

CaseResult as_case(const PaperResult& result) {
  CaseResult out{
      .info = case_info(result.info), .rows = {}, .transported = result.transported, .seconds = result.seconds};
  for (const Claim& claim : result.claims) out.rows.insert(out.rows.end(), claim.rows.begin(), claim.rows.end());
  return out;
}

std::vector<Case> paper_cases() {
  std::vector<Case> out;
  for (const Paper& paper : all_papers()) {
    out.push_back({case_info(paper.info), true, [&paper](const Lab& lab) {
                     PaperResult result;
                     result.info = paper.info;
                     PaperSheet sheet(lab, result);
                     paper.run(sheet);
                     return as_case(result).rows;
                   }});
  }
  return out;
}

std::vector<Fault> paper_faults() {
  std::vector<Fault> out;
  for (const Paper& paper : all_papers()) {
    for (const PlantedFormula& fault : paper.faults) {
      out.push_back({.id = fault.id, .description = fault.description, .case_id = "papers/" + paper.info.id});
    }
  }
  return out;
}

}  // namespace xpr
