// Thousands of Kerr rays against their truth: kerr_ray_sweep SEED EACH. Prints what it found by family; 1 where a ray
// misses its own bound, a bound is wide, or a class or a number of turning points is wrong.
#include "kerr_ray_sweep.hpp"

#include <fmt/core.h>

#include <cstdlib>

int main(int count, char** arguments) {
  if (count != 3) {
    fmt::print(stderr, "usage: kerr_ray_sweep SEED EACH\n");
    return 2;
  }
  auto report = xpr::kerr_ray_sweep::swept(static_cast<unsigned>(std::atoi(arguments[1])), std::atoi(arguments[2]), 1);
  fmt::print("{:<22} {:>6} {:>10} {:>10} {:>10} {:>12} {:>12}\n", "errors in 2^-52", "rays", "median", "p99", "max",
             "worst/bound", "widest bound");
  for (auto& [name, finding] : report.findings) {
    std::sort(finding.misses.begin(), finding.misses.end());
    const std::size_t n = finding.misses.size();
    fmt::print("{:<22} {:>6} {:>10.2f} {:>10.1f} {:>10.1f} {:>12.2g} {:>12.2g}\n", name, n, finding.misses[n / 2],
               finding.misses[n * 99 / 100], finding.misses.back(), finding.worst_ratio, finding.widest_bound);
  }
  for (const std::string& fault : report.faults) fmt::print("FAULT {}\n", fault);
  fmt::print("{} rays, {} faults\n", report.rays, report.faults.size());
  return report.faults.empty() ? 0 : 1;
}
