// xprimeray list: everything that has an id.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "command.hpp"
#include "core/io/errors.hpp"
#include "core/io/json.hpp"
#include "integrators/stepper.hpp"
#include "metrics/catalogue.hpp"
#include "validation/case.hpp"

namespace xpr::cli {
namespace {

/// One line of a list.
struct Entry {
  std::string id;
  std::string text;
};

using Entries = std::vector<Entry>;

Entries metrics() {
  Entries entries;
  for (const CatalogueEntry& entry : catalogue()) {
    const auto same = [&](const Entry& e) { return e.id == entry.card->metric; };
    if (std::any_of(entries.begin(), entries.end(), same)) continue;
    std::string parameters;
    for (const ParameterCard& p : entry.parameters) {
      parameters += fmt::format("{}{} = {}", parameters.empty() ? "" : ", ", p.name, p.fallback);
    }
    const std::string_view title = entry.card->title;
    entries.push_back(
        {std::string(entry.card->metric),
         fmt::format("{}{}", title.substr(0, title.find(',')), parameters.empty() ? "" : " (" + parameters + ")")});
  }
  return entries;
}

Entries charts() {
  Entries entries;
  for (const CatalogueEntry& entry : catalogue()) {
    std::string coordinates;
    for (const Coordinate& c : entry.card->coordinates) {
      coordinates += fmt::format("{}{}", coordinates.empty() ? "" : ", ", c.name);
    }
    entries.push_back({fmt::format("{} {}", entry.card->metric, entry.card->chart), "(" + coordinates + ")"});
  }
  return entries;
}

Entries methods_listed() {
  Entries entries;
  for (const MethodCard& method : methods()) {
    entries.push_back({std::string(method.id), fmt::format("order {}, {}: {}", method.order,
                                                           method.adaptive ? "--tol" : "--step", method.title)});
  }
  return entries;
}

Entries cases_listed() {
  Entries entries;
  for (const Case& c : cases()) entries.push_back({c.info.id, c.info.claim});
  return entries;
}

Entries faults_listed() {
  Entries entries;
  for (const Fault& fault : faults()) {
    entries.push_back({fault.id, fmt::format("{} (caught by {})", fault.description, fault.case_id)});
  }
  return entries;
}

struct List {
  std::string_view name;
  Entries (*entries)();
};

constexpr std::array<List, 5> lists{{{"metrics", metrics},
                                     {"charts", charts},
                                     {"methods", methods_listed},
                                     {"cases", cases_listed},
                                     {"faults", faults_listed}}};

void print_list(const List& list, const OutputFlags& output) {
  const Entries entries = list.entries();
  if (output.json) {
    for (const Entry& e : entries) {
      fmt::print("{}\n", Json{{"list", std::string(list.name)}, {"id", e.id}, {"text", e.text}}.dump());
    }
    return;
  }
  std::size_t width = 0;
  for (const Entry& e : entries) width = std::max(width, e.id.size());
  fmt::print("{}\n", list.name);
  for (const Entry& e : entries) fmt::print("  {:{}}  {}\n", e.id, width, e.text);
}

int run_list(const std::string& what, const OutputFlags& output) {
  std::vector<std::string_view> names;
  bool printed = false;
  for (const List& list : lists) {
    names.push_back(list.name);
    if (!what.empty() && what != list.name) continue;
    print_list(list, output);
    printed = true;
  }
  if (!printed) throw InputError(unknown_name("list", what, names));
  return 0;
}

}  // namespace

Command register_list(CLI::App& program) {
  CLI::App* app = program.add_subcommand("list", "List metrics, charts, methods, cases and planted faults");
  const auto what = std::make_shared<std::string>();
  const auto output = std::make_shared<OutputFlags>();
  app->add_option("what", *what, "metrics, charts, methods, cases or faults (default: all of them)");
  add_output_flags(*app, *output);
  add_example(*app, "  xprimeray list metrics");
  return {app, [what, output] { return run_list(*what, *output); }};
}

}  // namespace xpr::cli
