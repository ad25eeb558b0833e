#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "validation/case.hpp"
#include "validation/families.hpp"
#include "validation/paper.hpp"

namespace xpr {

namespace {

/// In report order.
constexpr std::array families = {
    conformance_cases,  //
    flat_cases,        schwarzschild_cases, kerr_cases,      ellis_cases,   media_cases,
    grin_cases,        ellipsoid_cases,     numerical_cases, grading_cases, paper_cases,
};

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> list;
    for (const auto& family : families) {
      std::vector<Case> members = family();
      std::move(members.begin(), members.end(), std::back_inserter(list));
    }
    return list;
  }();
  return all;
}

}  // namespace xpr
