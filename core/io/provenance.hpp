// Where a result comes from: what every output says of the build, the machine and the day. Holds no path.
#pragma once

#include <string>

#include "core/io/json.hpp"

namespace xpr {

struct Provenance {
  std::string version;     ///< "0.1.0"
  std::string commit;      ///< of the source when built; "unknown" outside a git checkout
  bool dirty = false;      ///< tracked files differed from that commit
  std::string compiler;    ///< "GNU 12.2.0"
  std::string build_type;  ///< "Release"
  std::string flags;       ///< for C++, the ISA level's included
  std::string isa;         ///< "x86-64-v3"
  std::string hdf5;        ///< version of the library in use
  std::string cpu;         ///< model name; "unknown" where the system does not say
  std::string date;        ///< now, UTC, ISO 8601
};

[[nodiscard]] Provenance provenance();
[[nodiscard]] Json to_json(const Provenance& provenance);

}  // namespace xpr
