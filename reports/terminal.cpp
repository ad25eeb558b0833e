#include "reports/terminal.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/case_table.hpp"
#include "reports/digest.hpp"
#include "reports/meaningful.hpp"

namespace xpr {
namespace {

constexpr std::size_t line_width = 100;
// Of the lines between table and verdict, at least this many stay for what went wrong.
constexpr std::size_t lines_for_troubles = 6;

/// Cut at a character of UTF-8, never inside one.
std::string cut(std::string text, std::size_t width) {
  if (text.size() <= width) return text;
  std::size_t end = width - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "...";
}

std::string count_text(std::int64_t count) { return count == 0 ? "-" : grouped(count); }

std::string family_line(const std::string& name, const Counts& counts, const RatioTail& tail) {
  return fmt::format("{:<18} {:>7} {:>7} {:>6} {:>6} {:>8} {:>8}   {:>9}", cut(name, 18), grouped(counts.total()),
                     count_text(counts.pass), count_text(counts.fail), count_text(counts.error),
                     count_text(counts.inconclusive), count_text(counts.skipped), two_digits_or_na(tail.max));
}

std::vector<std::string> table_lines(const Digest& digest, std::size_t room) {
  std::vector<std::string> lines{fmt::format("{:<18} {:>7} {:>7} {:>6} {:>6} {:>8} {:>8}   {}", "family", "rows",
                                             "pass", "FAIL", "ERROR", "INCONCL", "SKIPPED", "worst error/tolerance")};
  std::vector<const FamilyDigest*> families;
  for (const FamilyDigest& family : digest.families) families.push_back(&family);
  // Where not all fit, those with trouble are shown.
  std::stable_partition(families.begin(), families.end(),
                        [](const FamilyDigest* family) { return family->counts.pass != family->counts.total(); });
  const bool all_fit = families.size() + 1 <= room;
  if (all_fit) {
    for (const FamilyDigest& family : digest.families) {
      lines.push_back(family_line(family.name, family.counts, family.tail));
    }
    return lines;
  }
  const std::size_t shown = room - 2;
  for (std::size_t i = 0; i < shown; ++i) {
    lines.push_back(family_line(families[i]->name, families[i]->counts, families[i]->tail));
  }
  lines.push_back(fmt::format("... and {} more families", families.size() - shown));
  return lines;
}

std::vector<std::string> trouble_lines(const Digest& digest) {
  std::vector<std::string> lines;
  for (const RowOfCase& at : digest.failures) {
    const Row& row = *at.row;
    std::string line = fmt::format("{:<12} ", verdict_word(row.verdict));
    if (measured(row)) line += fmt::format("{} x tolerance, ", two_digits_or_na(error_over_tolerance(row)));
    line += fmt::format("{}: {}", at.result->info.id, row.label);
    if (!measured(row) && !row.note.empty()) line += " (" + row.note + ")";
    lines.push_back(std::move(line));
  }
  for (const FaultResult* fault : digest.missed_faults) {
    lines.push_back(fmt::format("{:<12} planted fault {} (by {})", "NOT CAUGHT", fault->id, fault->case_id));
  }
  for (const RowOfCase& at : digest.skipped) {
    lines.push_back(fmt::format("{:<12} {}: {} ({})", "SKIPPED", at.result->info.id, at.row->label, at.row->note));
  }
  return lines;
}

}  // namespace

std::string terminal_verdict(const SuiteResult& suite, const std::filesystem::path& report) {
  const Digest summary = digest(suite);
  const std::vector<std::string> troubles = trouble_lines(summary);
  const std::size_t last_lines = report.empty() ? 1 : 2;
  const std::size_t blank_lines = 1 + (troubles.empty() ? 0U : 1U);
  const std::size_t room = screen_lines - last_lines - blank_lines;
  std::vector<std::string> lines = table_lines(summary, room - std::min(troubles.size(), lines_for_troubles));
  if (!troubles.empty()) {
    const std::size_t left = room - lines.size();
    const std::size_t shown = troubles.size() <= left ? troubles.size() : left - 1;
    lines.emplace_back();
    for (std::size_t i = 0; i < shown; ++i) lines.push_back(troubles[i]);
    if (shown < troubles.size()) lines.push_back(fmt::format("... and {} more", troubles.size() - shown));
  }
  lines.emplace_back();
  std::string out;
  for (const std::string& line : lines) out += cut(line, line_width) + '\n';
  out += summary.sentence + '\n';
  if (!report.empty()) out += fmt::format("report: {}\n", (report / "report.html").string());
  return out;
}

}  // namespace xpr
