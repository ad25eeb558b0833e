#include "report_inputs.hpp"

#include <fmt/format.h>

#include <utility>

#include "integrators/stepper.hpp"
#include "metrics/catalogue.hpp"

namespace xpr::cli {

ReportInputs new_report(SuiteResult suite, int threads, const std::string& out, double seconds) {
  ReportInputs inputs;
  inputs.suite = std::move(suite);
  inputs.provenance = provenance();
  inputs.circumstances = {
      {"threads", fmt::format("{}", threads)}, {"out", out}, {"seconds", fmt::format("{:.1f}", seconds)}};
  for (const CatalogueEntry& entry : catalogue()) {
    inputs.charts.push_back({std::string(entry.card->metric), std::string(entry.card->chart)});
  }
  for (const MethodCard& method : methods()) inputs.methods.emplace_back(method.id);
  return inputs;
}

}  // namespace xpr::cli
