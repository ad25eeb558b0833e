#include "reports/report_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "core/io/errors.hpp"
#include "core/io/hdf5_file.hpp"

namespace xpr {
namespace {

constexpr std::array<const char*, 2> files{"report.h5", "paper.h5"};

struct StoredRow {
  std::string verdict;
  double value = 0.0;
  double error_over_tolerance = 0.0;
};

struct StoredReport {
  std::string report_hash, rays_hash;
  std::map<std::string, StoredRow> rows;
};

std::optional<std::filesystem::path> file_of(const std::filesystem::path& directory) {
  for (const char* name : files) {
    if (std::filesystem::is_regular_file(directory / name)) return directory / name;
  }
  return std::nullopt;
}

void read_case(const Hdf5File& file, const std::string& name, StoredReport& out) {
  const std::string group = "/cases/" + name + "/";
  const std::vector<std::string> labels = file.read_strings(group + "label"),
                                 verdicts = file.read_enum(group + "verdict");
  const std::vector<double> values = file.read_doubles(group + "value"), errors = file.read_doubles(group + "error"),
                            tolerances = file.read_doubles(group + "tolerance");
  if (verdicts.size() != labels.size() || values.size() != labels.size() || errors.size() != labels.size() ||
      tolerances.size() != labels.size()) {
    throw InputError(group + ": its datasets differ in length; a report has one entry a row in each");
  }
  for (std::size_t k = 0; k < labels.size(); ++k) {
    // Rows of one name are told apart by their order.
    std::string row = name + ": " + labels[k];
    for (int again = 2; out.rows.contains(row); ++again) row = fmt::format("{}: {} ({})", name, labels[k], again);
    out.rows[row] = {verdicts[k], values[k], std::abs(errors[k]) / tolerances[k]};
  }
}

StoredReport read_report(const std::filesystem::path& directory) {
  const std::optional<std::filesystem::path> path = file_of(directory);
  if (!path) {
    throw InputError(
        fmt::format("{}: no report there; a report directory holds {}", directory.string(), fmt::join(files, " or ")));
  }
  const Hdf5File file = Hdf5File::open(*path);
  StoredReport out;
  for (const auto& [name, target] : {std::pair{"report_hash", &out.report_hash}, {"rays_hash", &out.rays_hash}}) {
    if (file.has_attribute("/provenance", name)) *target = file.text_attribute("/provenance", name);
  }
  for (const std::string& family : file.members("/cases")) {
    for (const std::string& name : file.members("/cases/" + family)) read_case(file, family + "/" + name, out);
  }
  return out;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

std::string listed(const char* what, const std::vector<std::string>& rows, std::size_t most) {
  std::string text = fmt::format("{} {}\n", rows.size(), what);
  for (std::size_t k = 0; k < std::min(most, rows.size()); ++k) text += "  " + rows[k] + "\n";
  if (rows.size() > most) text += fmt::format("  and {} more\n", rows.size() - most);
  return text;
}

}  // namespace

bool has_report(const std::filesystem::path& directory) { return file_of(directory).has_value(); }

ReportDifference compare_reports(const std::filesystem::path& before, const std::filesystem::path& after) {
  const StoredReport first = read_report(before), second = read_report(after);
  ReportDifference out;
  out.hash_before = first.report_hash;
  out.hash_after = second.report_hash;
  out.rays_before = first.rays_hash;
  out.rays_after = second.rays_hash;
  for (const auto& [name, row] : first.rows) {
    const auto found = second.rows.find(name);
    if (found == second.rows.end()) {
      out.gone.push_back(name);
      continue;
    }
    ++out.rows;
    const StoredRow& other = found->second;
    const RowChange change{
        name, row.verdict, other.verdict, row.value, other.value, row.error_over_tolerance, other.error_over_tolerance};
    if (row.verdict != other.verdict) {
      out.verdicts.push_back(change);
    } else if (!same_bits(row.value, other.value)) {
      out.values.push_back(change);
    }
  }
  for (const auto& [name, row] : second.rows) {
    if (!first.rows.contains(name)) out.added.push_back(name);
  }
  const auto moved = [](const RowChange& c) {
    const double change = std::abs(c.error_after - c.error_before);
    return std::isnan(change) ? 0.0 : change;
  };
  std::stable_sort(out.values.begin(), out.values.end(),
                   [&](const RowChange& a, const RowChange& b) { return moved(a) > moved(b); });
  return out;
}

std::string difference_text(const ReportDifference& difference, std::size_t most) {
  if (!difference.hash_before.empty() && difference.hash_before == difference.hash_after) {
    return fmt::format("the same: report_hash {}, {} rows\n", difference.hash_before, difference.rows);
  }
  const bool same_rays = !difference.rays_before.empty() && difference.rays_before == difference.rays_after;
  std::string text = fmt::format("{} rows in both; the rays are {}\n", difference.rows,
                                 same_rays ? "the same, bit for bit" : "not the same bits");
  std::vector<std::string> verdicts, values;
  for (const RowChange& c : difference.verdicts) {
    verdicts.push_back(fmt::format("{}: {} -> {}, error over tolerance {:.2g} -> {:.2g}", c.row, c.verdict_before,
                                   c.verdict_after, c.error_before, c.error_after));
  }
  for (const RowChange& c : difference.values) {
    values.push_back(fmt::format("{}: {:.17g} -> {:.17g}, error over tolerance {:.2g} -> {:.2g}", c.row, c.value_before,
                                 c.value_after, c.error_before, c.error_after));
  }
  return text + listed("verdicts moved", verdicts, most) + listed("rows are gone", difference.gone, most) +
         listed("rows are new", difference.added, most) + listed("numbers moved, verdicts did not", values, most);
}

}  // namespace xpr
