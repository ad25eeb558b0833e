// Numerical verification: what the integrators promise of themselves, whichever spacetime they are in.
#include <iterator>
#include <utility>

#include "validation/families.hpp"
#include "validation/families/numerical.hpp"

namespace xpr {

namespace numerical {

CaseInfo info(std::string_view name, std::string claim, std::string physics, std::string truth, TruthRank rank,
              std::string cites, std::string source) {
  return {.id = "numerical/" + std::string(name),
          .family = "numerical",
          .claim = std::move(claim),
          .physics = std::move(physics),
          .truth = std::move(truth),
          .rank = rank,
          .grades_metric = false,
          .cites = std::move(cites),
          .source = "validation/families/" + source};
}

}  // namespace numerical

std::vector<Case> numerical_cases() {
  std::vector<Case> all;
  for (const auto part : {numerical::order_cases, numerical::tolerance_cases, numerical::structure_cases,
                          numerical::long_run_cases, numerical::projection_cases, numerical::event_cases,
                          numerical::comparison_cases, numerical::fifty_digit_cases}) {
    std::vector<Case> cases = part();
    std::move(cases.begin(), cases.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace xpr
