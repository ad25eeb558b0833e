// One line: the rays_hash of this build, by one thread, at the narrowest and the widest lanes. What tools/repro builds
// with every compiler, optimisation level and x86-64 level; `xprimeray repro` tells more of one build.
#include <fmt/format.h>

#include "core/repro.hpp"

int main() {
  const auto runs = xpr::run_repro({.rays = 256, .threads = {1}, .lanes = {1, 8}});
  fmt::print("{}\n", xpr::reproduced(runs) ? runs.front().rays_hash : "lanes differ");
  return 0;
}
