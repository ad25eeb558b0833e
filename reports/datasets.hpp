// The results of a suite as named columns: what report.h5 holds and what the two hashes are taken over.
//
//   /cases/<family>/<case>/{label, value, reference, reference_error, error, tolerance, verdict, ...}
//   /cases/<family>/<case>/parameter/<name>      dimension scales of all of the above, with `label`
//   /sweeps/<metric>/<method>/<chart>/<quantity>/{setting, error_norm, ...}
//   /faults/{id, case, error, caught, ...}
//   /volatile/...                                wall times: never hashed
//
// What was not measured (a skipped row, an exception) is NaN, never 0.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/io/hdf5_file.hpp"
#include "validation/result.hpp"

namespace xpr {

/// Codes that index names.
struct EnumColumn {
  std::vector<std::int64_t> codes;
  std::vector<std::string_view> names;  ///< of static lifetime
};

struct Dataset {
  std::string path;
  DatasetText text;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>, EnumColumn> values;
  std::string scale_name;           ///< not empty: a dimension scale of that name
  std::vector<std::string> scales;  ///< paths of the scales attached to dimension 0
};

/// A group and its text attributes.
struct GroupText {
  std::string path;
  std::vector<std::pair<std::string, std::string>> attributes;
};

struct Datasets {
  std::vector<GroupText> groups;
  std::vector<Dataset> columns;
};

/// 32 hexadecimal digits each (DESIGN section 6).
struct Hashes {
  std::string report;  ///< over every column of result_datasets: truth, errors and verdicts included
  std::string
      rays;  ///< over what transport put out: the ends of all rays traced by the cases, drifts and costs of the sweeps
};

/// Cases, sweeps and faults.
[[nodiscard]] Datasets result_datasets(const SuiteResult& suite);
/// Wall times of cases and sweeps, under /volatile.
[[nodiscard]] Datasets timing_datasets(const SuiteResult& suite);
[[nodiscard]] Hashes hashes(const SuiteResult& suite);

/// Writes groups and columns, attaches the scales.
void write_datasets(Hdf5File& file, const Datasets& datasets);

}  // namespace xpr
