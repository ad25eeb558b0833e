// Where the numbers of an HDF5 report come from: /provenance, which the same build and command repeat, and /volatile,
// which they do not (DESIGN section 6).
#pragma once

#include "core/io/hdf5_file.hpp"
#include "core/io/json.hpp"
#include "core/io/provenance.hpp"
#include "reports/page.hpp"

namespace xpr {

/// What of the build goes with every number.
[[nodiscard]] Facts provenance_facts(const Provenance& from);
/// What differs from run to run, or from machine to machine.
[[nodiscard]] Facts volatile_facts(const Provenance& from);

/// A resolved configuration as every report stores it; bytes that are no UTF-8 are replaced.
[[nodiscard]] std::string configuration_text(const Json& configuration);

/// How a report was made.
struct Origin {
  const Provenance& provenance;
  const std::string& command;
  const Json& configuration;
  Facts hashes;  ///< name and hexadecimal digits
};

/// Makes the groups /provenance and /volatile; more attributes may follow.
void write_origin(Hdf5File& file, const Origin& origin);

}  // namespace xpr
