#include "reports/card_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/atomic_output.hpp"
#include "reports/card_files.hpp"
#include "reports/page.hpp"

namespace xpr {
namespace {

// A directory that holds this file is an earlier card, and may be replaced.
constexpr const char* marker = "card.h5";

std::string number(double x) { return std::isnan(x) ? "na" : fmt::format("{:.1e}", x); }

Tone tone_of(Letter letter) {
  if (letter <= Letter::a) return Tone::good;
  return letter == Letter::f ? Tone::bad : Tone::plain;
}

Cell letter_cell(Letter letter, bool known) {
  return known ? Cell{std::string(to_string(letter)), tone_of(letter)} : Cell{"na", Tone::muted};
}

Cell count_cell(std::int64_t count, bool bad) {
  return {std::to_string(count), bad && count > 0 ? Tone::bad : Tone::plain};
}

void headline(const CardInputs& inputs, Page& page) {
  const ReportCard& card = inputs.main_card();
  const Marks& marks = card.as_handed_in;
  page.paragraph(fmt::format("Grade: {}", grade_text(card)), marks.grade == Letter::f   ? Tone::bad
                                                             : marks.grade <= Letter::a ? Tone::good
                                                                                        : Tone::warning);
  const ChallengeSet& set = inputs.examiner->set();
  Facts facts{{"code", inputs.name},
              {"set", fmt::format("{}: {}", set.id, set.title)},
              {"rays", fmt::format("{}, of which {} failed", marks.rays, marks.failed)},
              {"chart", card.hand_in.chart},
              {"truth", "closed form at each ray's own end point (rank: closed form)"}};
  if (inputs.cards.size() > 1) facts.emplace_back("graded at", card.label);
  page.facts(facts);
  for (const std::string& note : inputs.notes) page.paragraph(note);
}

void mistakes(const ReportCard& card, Page& page) {
  if (card.mistakes.empty()) return;
  page.begin({.level = 2, .title = "Mistakes of convention", .anchor = "conventions", .tone = Tone::warning});
  page.paragraph(
      "The errors of the table as handed in are explained by these. Everything below is graded with them undone; the "
      "grade of the table as it stands is the first one above.",
      Tone::warning);
  Table table{.columns = {{"mistake"}, {"what"}, {"seen in"}, {"third quartile before", true}, {"after", true}},
              .rows = {}};
  for (const ConventionFound& found : card.mistakes) {
    const Convention& convention = *found.convention;
    const std::string says = convention.chart.empty() ? std::string(convention.says)
                                                      : fmt::format("the table is in chart {}, not {}",
                                                                    convention.chart, card.hand_in.chart);
    table.rows.push_back({{std::string(convention.id)},
                          {says},
                          {std::string(quantity_cards[static_cast<std::size_t>(convention.shows)].id)},
                          {number(found.before)},
                          {number(found.after)}});
  }
  page.table(table);
  page.end();
}

void quantities(const ReportCard& card, Page& page) {
  page.begin({.level = 2, .title = "Errors", .anchor = "errors"});
  Table table{.columns = {{"quantity"},
                          {"rays", true},
                          {"median", true},
                          {"p90", true},
                          {"p99", true},
                          {"max", true},
                          {"median scaled", true},
                          {"p99 scaled", true},
                          {"max scaled", true},
                          {"worst ray", true},
                          {"letter"},
                          {"what it is"}},
              .rows = {}};
  for (std::size_t q = 0; q < quantity_count; ++q) {
    const Tail& tail = card.undone.tail[q];
    const QuantityCard& quantity = quantity_cards[q];
    const std::string unit = quantity.unit == "1" ? "" : fmt::format(" [{}]", quantity.unit);
    table.rows.push_back({{std::string(quantity.id) + unit},
                          {std::to_string(tail.rays)},
                          {number(tail.median)},
                          {number(tail.p90)},
                          {number(tail.p99)},
                          {number(tail.most)},
                          {number(tail.scaled_median)},
                          {number(tail.scaled_p99)},
                          {number(tail.scaled_most)},
                          {tail.worst < 0 ? "na" : std::to_string(tail.worst)},
                          letter_cell(tail.letter, tail.rays > 0),
                          {std::string(quantity.meaning)}});
  }
  page.table(table);
  const Marks& marks = card.undone;
  page.paragraph(
      fmt::format("Turns of phi: {} of {} rays have a wrong number{}. `na`: not handed in, or not told by this "
                  "chart. Scaled: with the closed form's own error, over the ray's condition where that is "
                  "more than 1.",
                  marks.wrong_turns, marks.counted_turns,
                  marks.counted_turns > 0 ? fmt::format(" (letter {})", to_string(marks.turns_letter)) : ""));
  page.end();
}

void outcomes(const CardInputs& inputs, const ReportCard& card, Page& page) {
  page.begin({.level = 2, .title = "What became of the rays", .anchor = "outcomes"});
  Table table{.columns = {{"outcome"}, {"rays", true}, {"meaning"}}, .rows = {}};
  constexpr std::array<std::string_view, outcome_names.size()> meanings{
      "right status, compared with the exact end",
      "captured, and handed in at or inside the horizon, where closed forms end: no error, no failure",
      "captured for escaped, the other way round, or out of the wrong side of a wormhole",
      "no end: a status such as max_steps, or, without statuses, a radius between",
      "nan or inf in the event",
      "right status, at a radius that the exact ray never comes to"};
  for (std::size_t k = 0; k < outcome_names.size(); ++k) {
    table.rows.push_back({{std::string(outcome_names[k])},
                          count_cell(card.undone.outcomes[k], failed(static_cast<Outcome>(k))),
                          {std::string(meanings[k])}});
  }
  page.table(table);
  std::string ids;
  std::int64_t named = 0;
  for (std::size_t k = 0; k < card.scores.size() && named < 20; ++k) {
    if (!failed(card.scores[k].outcome)) continue;
    ids += fmt::format("{}{} ({}, {})", named++ > 0 ? "; " : "", inputs.examiner->ray(k).ray.id,
                       inputs.examiner->set().families[static_cast<std::size_t>(inputs.examiner->ray(k).family)].name,
                       outcome_names[static_cast<std::size_t>(card.scores[k].outcome)]);
  }
  if (named > 0) {
    page.paragraph(fmt::format("Failed rays (letter {}): {}{}", to_string(card.undone.status_letter), ids,
                               card.undone.failed > named ? "; and more, in card.h5" : ""),
                   Tone::warning);
  }
  page.end();
}

void families(const ReportCard& card, Page& page) {
  page.begin({.level = 2, .title = "By family", .anchor = "families"});
  Table table{.columns = {{"family"},
                          {"rays", true},
                          {"failed", true},
                          {"direction, median", true},
                          {"direction, p99", true},
                          {"direction, p99 scaled", true},
                          {"time, p99 scaled", true},
                          {"heading, p99 scaled", true},
                          {"what it is"}},
              .rows = {}};
  for (const FamilyMarks& family : card.families) {
    table.rows.push_back({{std::string(family.name)},
                          {std::to_string(family.rays)},
                          count_cell(family.failed, true),
                          {number(family.tail[0].median)},
                          {number(family.tail[0].p99)},
                          {number(family.tail[0].scaled_p99)},
                          {number(family.tail[2].scaled_p99)},
                          {number(family.tail[3].scaled_p99)},
                          {std::string(family.what)}});
  }
  page.table(table);
  page.end();
}

void work_precision(const CardInputs& inputs, Page& page) {
  if (inputs.cards.size() < 2) return;
  page.begin({.level = 2, .title = "Work and precision", .anchor = "work"});
  Table table{.columns = {{"table"},
                          {"tolerance", true},
                          {"work a ray", true},
                          {"unit"},
                          {"failed", true},
                          {"direction, median", true},
                          {"direction, p99", true},
                          {"swept, median", true},
                          {"time, median", true},
                          {"grade"}},
              .rows = {}};
  for (const ReportCard& card : inputs.cards) {
    const Marks& marks = card.undone;
    table.rows.push_back({{card.label},
                          {number(card.tolerance)},
                          {std::isnan(card.hand_in.work) ? "na" : fmt::format("{:.4g}", card.hand_in.work)},
                          {card.hand_in.work_unit.empty() ? "na" : card.hand_in.work_unit},
                          count_cell(marks.failed, true),
                          {number(marks.tail[0].median)},
                          {number(marks.tail[0].p99)},
                          {number(marks.tail[1].median)},
                          {number(marks.tail[2].median)},
                          {grade_text(card), tone_of(card.as_handed_in.grade)}});
  }
  page.table(table);
  page.end();
}

void definition(Page& page) {
  page.begin({.level = 2, .title = "What the grade means", .anchor = "grade"});
  Table table{.columns = {{"letter"}, {"p99 of the scaled errors", true}, {"rays that failed", true}}, .rows = {}};
  for (std::size_t k = 0; k < letter_errors.size(); ++k) {
    table.rows.push_back(
        {{std::string(letter_names[k])},
         {fmt::format("at most {:.0e}", letter_errors[k])},
         {letter_shares[k] == 0.0 ? "none" : fmt::format("at most {:g} %", 100.0 * letter_shares[k])}});
  }
  table.rows.push_back({{"F"}, {"more, or nothing to compare"}, {"more"}});
  page.table(table);
  page.paragraph(
      "Each quantity that was handed in gets a letter, so do the share of failed rays and the share of rays with a "
      "wrong "
      "number of turns; the grade is the worst of them. With several tables it is the one at the tightest tolerance. "
      "Mistakes of convention are undone for a second grade only.");
  page.end();
}

void compose_card(const CardInputs& inputs, const FigureSet& figures, Page& page) {
  const ReportCard& card = inputs.main_card();
  page.title(fmt::format("Report card: {} on {}", inputs.name, inputs.examiner->set().id));
  headline(inputs, page);
  mistakes(card, page);
  quantities(card, page);
  outcomes(inputs, card, page);
  families(card, page);
  work_precision(inputs, page);
  if (!figures.drawn.empty() || !figures.problems.empty()) {
    page.begin({.level = 2, .title = "Figures", .anchor = "figures"});
    for (const Picture& picture : figures.drawn) page.picture(picture);
    for (const std::string& problem : figures.problems) page.paragraph(problem, Tone::warning);
    page.end();
  }
  definition(page);
  page.begin({.level = 2, .title = "Where this comes from", .anchor = "provenance"});
  page.facts({{"repeat", inputs.command},
              {"version", fmt::format("{} {}{}", inputs.provenance.version, inputs.provenance.commit,
                                      inputs.provenance.dirty ? " with changes that are not committed" : "")},
              {"compiler", inputs.provenance.compiler},
              {"numbers", "every ray in card.h5, the summary in card.json"}});
  page.end();
}

Json tail_json(const Tail& tail) {
  return {{"rays", tail.rays},
          {"median", json_number(tail.median)},
          {"p90", json_number(tail.p90)},
          {"p99", json_number(tail.p99)},
          {"max", json_number(tail.most)},
          {"scaled_median", json_number(tail.scaled_median)},
          {"scaled_p99", json_number(tail.scaled_p99)},
          {"scaled_max", json_number(tail.scaled_most)},
          {"worst", tail.worst},
          {"letter", tail.rays > 0 ? std::string(to_string(tail.letter)) : "na"}};
}

Json marks_json(const Marks& marks) {
  Json json{{"grade", std::string(to_string(marks.grade))}, {"rays", marks.rays}, {"failed", marks.failed}};
  for (std::size_t k = 0; k < outcome_names.size(); ++k) {
    json["outcomes"][std::string(outcome_names[k])] = marks.outcomes[k];
  }
  json["turns"] = {{"counted", marks.counted_turns}, {"wrong", marks.wrong_turns}};
  for (std::size_t q = 0; q < quantity_count; ++q) {
    json["quantities"][std::string(quantity_cards[q].id)] = tail_json(marks.tail[q]);
  }
  return json;
}

Json one_card(const ReportCard& card) {
  Json json{{"label", card.label},
            {"file", card.hand_in.file},
            {"chart", card.hand_in.chart},
            {"tolerance", json_number(card.tolerance)},
            {"work", json_number(card.hand_in.work)},
            {"work_unit", card.hand_in.work_unit},
            {"grade", std::string(to_string(card.as_handed_in.grade))},
            {"mistakes", Json::array()}};
  for (const ConventionFound& found : card.mistakes) {
    json["mistakes"].push_back({{"id", std::string(found.convention->id)},
                                {"says", std::string(found.convention->says)},
                                {"before", json_number(found.before)},
                                {"after", json_number(found.after)}});
  }
  json["as_handed_in"] = marks_json(card.as_handed_in);
  json["undone"] = marks_json(card.undone);
  return json;
}

}  // namespace

const ReportCard& CardInputs::main_card() const {
  const ReportCard* best = &cards.back();
  for (const ReportCard& card : cards) {
    if (card.tolerance < best->tolerance || (std::isnan(best->tolerance) && !std::isnan(card.tolerance))) best = &card;
  }
  return *best;
}

void check_card_directory(const std::filesystem::path& directory) { const AtomicDirectory probe(directory, marker); }

std::string grade_text(const ReportCard& card) {
  if (card.mistakes.empty()) return std::string(to_string(card.as_handed_in.grade));
  std::string names;
  for (const ConventionFound& found : card.mistakes) {
    names += (names.empty() ? "" : ", ") + std::string(found.convention->id);
  }
  return fmt::format("{} as handed in, {} once undone: {}", to_string(card.as_handed_in.grade),
                     to_string(card.undone.grade), names);
}

Json card_json(const CardInputs& inputs) {
  Json json{{"schema", "xprimeray-card"},
            {"schema_version", 1},
            {"set", std::string(inputs.examiner->set().id)},
            {"name", inputs.name},
            {"grade", std::string(to_string(inputs.main_card().as_handed_in.grade))},
            {"grade_undone", std::string(to_string(inputs.main_card().undone.grade))},
            {"configuration", inputs.configuration},
            {"cards", Json::array()}};
  for (const ReportCard& card : inputs.cards) json["cards"].push_back(one_card(card));
  json["volatile"] = {{"seconds", inputs.seconds}, {"provenance", to_json(inputs.provenance)}};
  return json;
}

std::string card_text(const CardInputs& inputs) {
  const ReportCard& card = inputs.main_card();
  std::string text = fmt::format("{} on {}: {}\n", inputs.name, inputs.examiner->set().id, grade_text(card));
  for (const ConventionFound& found : card.mistakes) {
    text += fmt::format("  {}: {} (third quartile {} -> {})\n", found.convention->id, found.convention->says,
                        number(found.before), number(found.after));
  }
  text += fmt::format("  {} rays, {} failed\n", card.undone.rays, card.undone.failed);
  text += fmt::format("  {:<10} {:>7} {:>9} {:>9} {:>9} {:>11}  {}\n", "error", "rays", "median", "p99", "max",
                      "p99 scaled", "letter");
  for (std::size_t q = 0; q < quantity_count; ++q) {
    const Tail& tail = card.undone.tail[q];
    text += fmt::format("  {:<10} {:>7} {:>9} {:>9} {:>9} {:>11}  {}\n", quantity_cards[q].id, tail.rays,
                        number(tail.median), number(tail.p99), number(tail.most), number(tail.scaled_p99),
                        tail.rays > 0 ? to_string(tail.letter) : "na");
  }
  return text;
}

std::vector<std::string> write_card(const CardInputs& inputs, const std::filesystem::path& directory) {
  AtomicDirectory out(directory, marker);
  write_card_h5(inputs, out.path() / "card.h5");
  const FigureSet figures = draw_figures(inputs.figure_tools, out.path(), marker);
  const auto markdown = make_markdown_page();
  compose_card(inputs, figures, *markdown);
  write_file(out.path() / "card.md", markdown->finish());
  const auto html = make_html_page();
  compose_card(inputs, figures, *html);
  write_file(out.path() / "card.html", html->finish());
  write_file(out.path() / "card.json", card_json(inputs).dump(2) + "\n");
  write_file(out.path() / "badge.svg", badge_svg(inputs.examiner->set().id, inputs.main_card().as_handed_in.grade));
  out.commit();
  return figures.problems;
}

}  // namespace xpr
