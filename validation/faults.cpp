#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "validation/case.hpp"
#include "validation/families.hpp"
#include "validation/paper.hpp"

namespace xpr {

namespace {

constexpr std::array families = {
    metric_faults, flat_faults, schwarzschild_faults, kerr_faults,    ellis_faults,
    media_faults,  grin_faults, numerical_faults,     grading_faults, paper_faults,
};

}  // namespace

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all = [] {
    std::vector<Fault> list;
    for (const auto& family : families) {
      std::vector<Fault> members = family();
      std::move(members.begin(), members.end(), std::back_inserter(list));
    }
    return list;
  }();
  return all;
}

}  // namespace xpr
