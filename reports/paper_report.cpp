#include "reports/paper_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include "core/io/atomic_output.hpp"
#include "core/io/hdf5_file.hpp"
#include "reports/case_table.hpp"
#include "reports/digest.hpp"
#include "reports/junit.hpp"
#include "reports/meaningful.hpp"
#include "reports/origin.hpp"
#include "reports/page.hpp"
#include "reports/report.hpp"
#include "reports/text.hpp"

namespace xpr {
namespace {

// A directory that holds this file is an earlier report, and may be replaced.
constexpr const char* marker = "paper.h5";

constexpr std::array looks{"line", "dashed", "dotted", "dots", "printed", "area"};

std::string exact_text(const Claim& claim) {
  return meaningful(claim.exact.value, std::max(claim.exact.error, 1e-12 * std::abs(claim.exact.value)));
}

/// "162 (wrong)"; numbers known from memory only are not shown as if printed.
std::string printed_text(const Claim& claim) {
  if (!claim.printed.empty()) return claim.misprint ? claim.printed + " (wrong)" : claim.printed;
  return claim.printed_source.empty() ? "-" : "not established";
}

/// Rows of ours: neither the printed number nor a formula known to be wrong, whose rows have a unit of their own.
std::vector<const Row*> ours(const Claim& claim) {
  std::vector<const Row*> rows;
  for (const Row& row : claim.rows) {
    const bool of_ours = row.verdict != Verdict::skipped && row.reference == claim.exact.value &&
                         row.label.find(": as printed") == std::string::npos;
    if (of_ours) rows.push_back(&row);
  }
  return rows;
}

/// The value of the route that is farthest off, and the errors of all routes.
std::pair<std::string, std::string> ours_text(const Claim& claim) {
  std::string errors;
  const Row* worst = nullptr;
  for (const Row* row : ours(claim)) {
    errors += (errors.empty() ? "" : ", ") + error_text(*row, row->error);
    if (worst == nullptr || error_over_tolerance(*row) > error_over_tolerance(*worst)) worst = row;
  }
  return {worst == nullptr ? "-" : value_text(*worst), errors.empty() ? "-" : errors};
}

Cell claim_verdict(const Claim& claim) {
  Row row;
  row.verdict = verdict_of(claim);
  return verdict_cell(row);
}

std::string paper_sentence(const PaperResult& result) {
  std::size_t routes = 0;
  for (const Claim& claim : result.claims) routes += ours(claim).size();
  const Counts counts = count_claims(result);
  std::string text = fmt::format("{}: {} by {}", counted(counts.total(), "claim"), counts_in_words(counts),
                                 counted(static_cast<std::int64_t>(routes), "route"));
  const auto findings = static_cast<std::int64_t>(result.findings.size());
  if (findings > 0) text += "; " + counted(findings, "finding");
  return text + ".";
}

Tone tone_of(const PaperResult& result) {
  const Counts counts = count_claims(result);
  if (counts.fail + counts.error > 0) return Tone::bad;
  return counts.inconclusive > 0 ? Tone::warning : Tone::good;
}

Table claim_table(const PaperResult& result) {
  Table table{{{"quantity"},
               {"unit"},
               {"printed", true},
               {"exact", true},
               {"ours, the route farthest off", true},
               {"errors of all routes", true},
               {"verdict"}},
              {}};
  for (const Claim& claim : result.claims) {
    const auto [value, errors] = ours_text(claim);
    table.rows.push_back({{claim.quantity},
                          {claim.unit},
                          {printed_text(claim), claim.misprint ? Tone::warning : Tone::plain},
                          {exact_text(claim)},
                          {value},
                          {errors},
                          claim_verdict(claim)});
  }
  return table;
}

void chapter(Page& page, const std::string& title, const std::function<void()>& inside) {
  page.begin({2, title, slug(title), Tone::plain});
  inside();
  page.end();
}

void compose_paper(const PaperResult& result, const FigureSet& figures, const std::string& command, Page& page) {
  page.title(result.info.reference);
  page.paragraph(result.info.reproduced);
  page.paragraph(paper_sentence(result), tone_of(result));
  for (const Picture& picture : figures.drawn) {
    if (picture.file == "figures/" + result.info.id) page.picture(picture);
  }
  chapter(page, "Printed, exact, ours", [&] { page.table(claim_table(result)); });
  if (!result.findings.empty()) {
    chapter(page, "Findings", [&] {
      for (const PaperFinding& finding : result.findings) page.facts({{finding.where, finding.text}});
    });
  }
  chapter(page, "Not checked", [&] {
    for (const std::string& text : result.info.not_checked) page.paragraph(text);
    if (result.info.not_checked.empty()) page.paragraph("Nothing that the catalogue of results names.");
  });
  chapter(page, "Every route", [&] {
    const CaseTable rows = case_table(as_case(result));
    page.facts(rows.facts);
    page.table(rows.table);
  });
  chapter(page, "How to reproduce", [&] { page.listing(command); });
}

void compose_overview(const PaperReportInputs& inputs, const PaperReportOutcome& outcome, const std::string& ending,
                      Page& page) {
  page.title("Published results, reproduced");
  const SuiteResult suite = as_suite(inputs.results);
  const Digest summary = digest(suite);
  page.paragraph(summary.sentence, summary.failures.empty() ? Tone::good : Tone::bad);
  for (const std::string& problem : outcome.figure_problems) page.paragraph(problem, Tone::warning);
  Table table{
      {{"paper"}, {"reproduced"}, {"claims", true}, {"findings", true}, {"worst error/tolerance", true}, {"verdict"}},
      {}};
  for (std::size_t k = 0; k < inputs.results.size(); ++k) {
    const PaperResult& result = inputs.results[k];
    double worst = 0.0;
    for (const Row& row : suite.cases[k].rows) worst = std::max(worst, measured(row) ? error_over_tolerance(row) : 0.0);
    table.rows.push_back({{result.info.id, Tone::plain, "", result.info.id + ending},
                          {result.info.reproduced},
                          {counted(static_cast<std::int64_t>(result.claims.size()), "claim")},
                          {grouped(static_cast<std::int64_t>(result.findings.size()))},
                          {two_digits(worst)},
                          {counts_in_words(count_claims(result)), tone_of(result)}});
  }
  page.table(table);
  chapter(page, "Findings", [&] {
    for (const PaperResult& result : inputs.results) {
      for (const PaperFinding& finding : result.findings) {
        page.facts({{result.info.id + ", " + finding.where, finding.text}});
      }
    }
  });
  chapter(page, "How to reproduce", [&] {
    page.listing(inputs.command);
    page.facts({{"rays_hash", outcome.hashes.rays}, {"report_hash", outcome.hashes.report}});
  });
}

template <class Get>
std::vector<std::string> texts(const std::vector<Claim>& claims, const Get& get) {
  std::vector<std::string> out;
  for (const Claim& claim : claims) out.push_back(get(claim));
  return out;
}

void write_claims(Hdf5File& file, const PaperResult& result) {
  const std::string group = "/papers/" + result.info.id;
  file.make_group(group);
  file.set_attribute(group, "reference", result.info.reference);
  file.set_attribute(group, "reproduced", result.info.reproduced);
  const auto put = [&](const std::string& name, const std::vector<std::string>& values, const std::string& meaning) {
    file.write(fmt::format("{}/claims/{}", group, name), values, {"1", meaning});
  };
  const std::vector<Claim>& claims = result.claims;
  put("quantity", texts(claims, [](const Claim& c) { return c.quantity; }), "what is claimed");
  put("unit", texts(claims, [](const Claim& c) { return c.unit; }), "unit of printed and exact number");
  put("printed", texts(claims, [](const Claim& c) { return c.printed; }), "as printed; empty where none is known");
  put("printed_source", texts(claims, [](const Claim& c) { return c.printed_source; }), "where that was read");
  put("exact_by", texts(claims, [](const Claim& c) { return c.exact_by; }), "what the exact number comes from");
  put("verdict", texts(claims, [](const Claim& c) { return std::string(to_string(verdict_of(c))); }), "verdict");
  std::vector<double> exact, error;
  for (const Claim& claim : claims) {
    exact.push_back(claim.exact.value);
    error.push_back(claim.exact.error);
  }
  file.write(group + "/claims/exact", exact, {"see the dataset unit", "exact number"});
  file.write(group + "/claims/exact_error", error, {"see the dataset unit", "absolute error of the exact number"});
  std::vector<std::string> where, text;
  for (const PaperFinding& finding : result.findings) {
    where.push_back(finding.where);
    text.push_back(finding.text);
  }
  file.write(group + "/findings/where", where, {"1", "what is wrong"});
  file.write(group + "/findings/text", text, {"1", "the proof"});
}

void write_figure(Hdf5File& file, const PaperResult& result) {
  const Figure& figure = result.figure;
  if (figure.panels.empty()) return;
  const std::string group = "/figures/" + result.info.id;
  file.make_group(group);
  file.set_attribute(group, "title", figure.title);
  file.set_attribute(group, "caption", figure.caption);
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const Panel& panel = figure.panels[p];
    const std::string at = fmt::format("{}/panel_{}", group, p);
    file.make_group(at);
    file.set_attribute(at, "title", panel.title);
    file.set_attribute(at, "x_label", panel.x_label);
    file.set_attribute(at, "y_label", panel.y_label);
    file.set_attribute(at, "x_log", std::int64_t{panel.x_log});
    file.set_attribute(at, "y_log", std::int64_t{panel.y_log});
    file.set_attribute(at, "equal", std::int64_t{panel.equal});
    for (std::size_t s = 0; s < panel.series.size(); ++s) {
      const Series& series = panel.series[s];
      const std::string one = fmt::format("{}/series_{:02}", at, s);
      file.write(one + "/x", series.x, {"1", panel.x_label});
      file.write(one + "/y", series.y, {"1", panel.y_label});
      file.set_attribute(one, "name", series.name);
      file.set_attribute(one, "look", looks[static_cast<std::size_t>(series.look)]);
    }
  }
}

void write_h5(const PaperReportInputs& inputs, const SuiteResult& suite, const Hashes& found,
              const std::filesystem::path& path) {
  Hdf5File file = Hdf5File::create(path);
  file.set_attribute("/", "schema", "xprimeray-papers");
  file.set_attribute("/", "schema_version", report_schema_version);
  write_datasets(file, result_datasets(suite));
  file.make_group("/figures");
  for (const PaperResult& result : inputs.results) {
    write_claims(file, result);
    write_figure(file, result);
  }
  write_origin(file, {inputs.provenance,
                      inputs.command,
                      inputs.configuration,
                      {{"report_hash", found.report}, {"rays_hash", found.rays}}});
  file.set_attribute("/volatile", "seconds", inputs.seconds);
  write_datasets(file, timing_datasets(suite));
  file.close();
}

Json counts_json(const Counts& counts) {
  return {{"pass", counts.pass},   {"fail", counts.fail},       {"inconclusive", counts.inconclusive},
          {"error", counts.error}, {"skipped", counts.skipped}, {"total", counts.total()}};
}

std::string summary_json(const PaperReportInputs& inputs, const SuiteResult& suite, const PaperReportOutcome& outcome) {
  Json papers = Json::object();
  std::size_t findings = 0;
  for (const PaperResult& result : inputs.results) {
    findings += result.findings.size();
    papers[result.info.id] = {{"claims", counts_json(count_claims(result))},
                              {"rows", counts_json(count(as_case(result)))},
                              {"findings", result.findings.size()}};
  }
  const Json summary = {{"schema", "xprimeray-papers-summary"},
                        {"schema_version", report_schema_version},
                        {"exit_code", exit_code(suite)},
                        {"counts", counts_json(count(suite))},
                        {"findings", findings},
                        {"papers", std::move(papers)},
                        {"report_hash", outcome.hashes.report},
                        {"rays_hash", outcome.hashes.rays},
                        {"figure_problems", outcome.figure_problems},
                        {"command", inputs.command},
                        {"version", inputs.provenance.version},
                        {"commit", inputs.provenance.commit}};
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

SuiteResult as_suite(const std::vector<PaperResult>& results) {
  SuiteResult suite;
  suite.suite = "papers";
  for (const PaperResult& result : results) suite.cases.push_back(as_case(result));
  return suite;
}

void check_paper_directory(const std::filesystem::path& directory) { const AtomicDirectory probe(directory, marker); }

PaperReportOutcome write_paper_report(const PaperReportInputs& inputs, const std::filesystem::path& directory) {
  AtomicDirectory out(directory, marker);
  const SuiteResult suite = as_suite(inputs.results);
  PaperReportOutcome outcome{hashes(suite), {}};
  write_h5(inputs, suite, outcome.hashes, out.path() / marker);
  const FigureSet figures = draw_figures(inputs.figure_tools, out.path(), marker);
  outcome.figure_problems = figures.problems;
  for (const auto& [ending, make] : {std::pair{".md", &make_markdown_page}, {".html", &make_html_page}}) {
    for (const PaperResult& result : inputs.results) {
      const std::unique_ptr<Page> page = make();
      compose_paper(result, figures, "xprimeray paper " + result.info.id, *page);
      write_file(out.path() / (result.info.id + ending), page->finish());
    }
    const std::unique_ptr<Page> page = make();
    compose_overview(inputs, outcome, ending, *page);
    write_file(out.path() / (std::string("overview") + ending), page->finish());
  }
  write_file(out.path() / "junit.xml", junit_xml(suite));
  write_file(out.path() / "summary.json", summary_json(inputs, suite, outcome));
  out.commit();
  return outcome;
}

std::string paper_line(const PaperResult& result) {
  return fmt::format("{}: {}\n", result.info.id, paper_sentence(result));
}

std::string paper_text(const PaperResult& result) {
  const Table table = claim_table(result);
  std::vector<std::size_t> width;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    width.push_back(table.columns[k].title.size());
    for (const auto& row : table.rows) width[k] = std::max(width[k], row[k].text.size());
  }
  std::string text = fmt::format("{}\n{}\n\n", result.info.reference, result.info.reproduced);
  const auto line = [&](const auto& cell_text) {
    std::string out;
    for (std::size_t k = 0; k < width.size(); ++k) {
      const std::string cell = cell_text(k);
      out +=
          table.columns[k].number ? fmt::format("{:>{}}  ", cell, width[k]) : fmt::format("{:<{}}  ", cell, width[k]);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    return out + "\n";
  };
  text += line([&](std::size_t k) { return table.columns[k].title; });
  for (const auto& row : table.rows) text += line([&](std::size_t k) { return row[k].text; });
  for (const PaperFinding& finding : result.findings)
    text += fmt::format("\nfinding: {}: {}\n", finding.where, finding.text);
  for (const Claim& claim : result.claims) {
    for (const Row& row : claim.rows) {
      if (row.verdict == Verdict::pass || row.verdict == Verdict::skipped) continue;
      text += fmt::format("\n{}: {}: {} against {}, error {}, tolerance {} ({})\n", verdict_word(row.verdict),
                          row.label, value_text(row), reference_text(row), error_text(row, row.error),
                          error_text(row, row.tolerance), reason_and_note(row));
    }
  }
  return text + "\n" + paper_line(result);
}

}  // namespace xpr
