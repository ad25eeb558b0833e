#include "core/io/provenance.hpp"

#include <array>
#include <ctime>
#include <fstream>

#include "core/io/hdf5_file.hpp"
#include "xprimeray_build.hpp"

namespace xpr {
namespace {

std::string cpu_model() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string now() {
  const std::time_t seconds = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> text;
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

}  // namespace

Provenance provenance() {
  return {.version = build::version,
          .commit = build::commit,
          .dirty = build::dirty,
          .compiler = build::compiler,
          .build_type = build::build_type,
          .flags = build::flags,
          .isa = build::isa,
          .hdf5 = hdf5_version(),
          .cpu = cpu_model(),
          .date = now()};
}

Json to_json(const Provenance& provenance) {
  return {{"version", provenance.version},
          {"commit", provenance.commit},
          {"dirty", provenance.dirty},
          {"compiler", provenance.compiler},
          {"build_type", provenance.build_type},
          {"flags", provenance.flags},
          {"isa", provenance.isa},
          {"hdf5", provenance.hdf5},
          {"cpu", provenance.cpu},
          {"date", provenance.date}};
}

}  // namespace xpr
