// xprimeray doctor: what this build can do on this machine, and what would help.
#include <fmt/format.h>
#include <tbb/info.h>

#include <cfenv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>

#include "command.hpp"
#include "core/io/json.hpp"
#include "core/io/provenance.hpp"

namespace xpr::cli {
namespace {

enum class Health { good, lacking, broken };

struct Finding {
  std::string name;
  Health health = Health::good;
  std::string text;
};

Finding build_finding() {
  const Provenance p = provenance();
  return {"build", Health::good,
          fmt::format("xprimeray {} ({}{}), {}, {}, {}", p.version, p.commit.substr(0, 12),
                      p.dirty ? ", with local changes" : "", p.compiler, p.build_type, p.flags)};
}

Finding isa_finding() {
  const Provenance p = provenance();
  bool runs = true;
#if defined(__x86_64__)
  if (p.isa == "x86-64-v3") runs = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (p.isa == "x86-64-v4") runs = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
#endif
  const std::string text = fmt::format("built for {}, running on {}", p.isa, p.cpu);
  if (runs) return {"isa", Health::good, text};
  return {"isa", Health::broken, text + ": configure again with -DXPRIMERAY_ISA=native"};
}

// Subnormals flushed to zero, another rounding mode or contracted products would change bits: results that are hashed
// need none of them.
Finding arithmetic_finding() {
  const volatile double smallest_normal = std::numeric_limits<double>::min();
  const volatile double half_ulp = 0.5 * std::numeric_limits<double>::epsilon();
  const volatile double near_one = 1.0 + std::numeric_limits<double>::epsilon();
  const volatile double square = near_one * near_one;
  std::string wrong;
  if (0.5 * smallest_normal == 0.0) wrong += " subnormals are flushed to zero (FTZ/DAZ);";
  if (std::fegetround() != FE_TONEAREST || 1.0 + half_ulp != 1.0 || -1.0 - half_ulp != -1.0) {
    wrong += " rounding is not to nearest;";
  }
  if (near_one * near_one - square != 0.0) wrong += " products are contracted into fused multiply-adds;";
  if (wrong.empty()) {
    return {"arithmetic", Health::good, "IEEE doubles to nearest, subnormals kept, no contraction"};
  }
  return {"arithmetic", Health::broken, wrong.substr(1) + " results will not be equal to the bit"};
}

Finding threads_finding() {
  return {"threads", Health::good, fmt::format("{} by default", tbb::info::default_concurrency())};
}

Finding hdf5_finding() { return {"hdf5", Health::good, "library " + provenance().hdf5 + ", serial"}; }

Finding figures_finding() {
  for (const std::string python : {"/usr/bin/python3", "python3"}) {
    const std::string probe = python + " -c 'import h5py, matplotlib, numpy' >/dev/null 2>&1";
    if (std::system(probe.c_str()) == 0) return {"figures", Health::good, python + " has h5py, matplotlib and numpy"};
  }
  return {"figures", Health::lacking,
          "no Python 3 with h5py, matplotlib and numpy; reports come without figures. On Debian: "
          "apt install python3-h5py python3-matplotlib python3-numpy, or tools/setup"};
}

Finding disk_finding() {
  std::error_code error;
  const auto space = std::filesystem::space(".", error);
  const double free_gb = error ? 0.0 : static_cast<double>(space.available) / 1e9;
  return {"disk", free_gb < 0.1 ? Health::lacking : Health::good, fmt::format("{:.1f} GB free here", free_gb)};
}

std::string_view word(Health health) {
  return health == Health::good ? "ok" : health == Health::lacking ? "missing" : "WRONG";
}

int run_doctor(const OutputFlags& output) {
  int exit_code = 0;
  for (const Finding& finding : {build_finding(), isa_finding(), arithmetic_finding(), threads_finding(),
                                 hdf5_finding(), figures_finding(), disk_finding()}) {
    if (finding.health == Health::broken) exit_code = 1;
    if (output.json) {
      const Json line{{"check", finding.name}, {"health", std::string(word(finding.health))}, {"text", finding.text}};
      fmt::print("{}\n", line.dump());
    } else if (!output.quiet || finding.health != Health::good) {
      fmt::print("{:10}  {:7}  {}\n", finding.name, word(finding.health), finding.text);
    }
  }
  return exit_code;
}

}  // namespace

Command register_doctor(CLI::App& program) {
  CLI::App* app = program.add_subcommand("doctor", "What this build can do on this machine");
  const auto output = std::make_shared<OutputFlags>();
  add_output_flags(*app, *output);
  add_example(*app, "  xprimeray doctor");
  return {app, [output] { return run_doctor(*output); }};
}

}  // namespace xpr::cli
