#include "reports/datasets.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "core/io/hash.hpp"
#include "reports/digest.hpp"

namespace xpr {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::array verdicts = {Verdict::pass, Verdict::fail, Verdict::inconclusive, Verdict::error, Verdict::skipped};

/// A name as one link of an HDF5 path: "b/M" -> "b_over_M".
std::string link_name(const std::string& name) {
  std::string out;
  for (const char c : name) out += c == '/' ? std::string("_over_") : std::string(1, c);
  return out.empty() || out == "." ? "unnamed" : out;
}

/// The first of name, name_2, name_3 ... that is not taken; takes it.
std::string untaken(std::set<std::string>& taken, const std::string& name) {
  std::string free = name;
  for (int i = 2; !taken.insert(free).second; ++i) free = fmt::format("{}_{}", name, i);
  return free;
}

/// The unit of a column whose rows may each have their own.
template <class Items, class Get>
std::string common_unit(const Items& items, Get unit_of) {
  if (items.empty()) return "1";
  const std::string& first = unit_of(items.front());
  for (const auto& item : items) {
    if (unit_of(item) != first) return "see the dataset unit";
  }
  return first;
}

/// One column per member of a list of things, under one group.
template <class Item>
class Columns {
 public:
  Columns(Datasets& out, std::string group, const std::vector<Item>& items)
      : out_(out), group_(std::move(group)), items_(items) {}

  template <class Get>
  void numbers(const std::string& name, std::string units, std::string long_name, Get get) {
    put<double>(name, std::move(units), std::move(long_name), get);
  }
  template <class Get>
  void integers(const std::string& name, std::string long_name, Get get) {
    put<std::int64_t>(name, "1", std::move(long_name), get);
  }
  template <class Get>
  void texts(const std::string& name, std::string long_name, Get get) {
    put<std::string>(name, "1", std::move(long_name), get);
  }
  template <class Get>
  void codes(const std::string& name, std::string long_name, std::vector<std::string_view> names, Get get) {
    EnumColumn column{{}, std::move(names)};
    for (const Item& item : items_) column.codes.push_back(get(item));
    out_.columns.push_back({group_ + "/" + name, {"1", std::move(long_name)}, std::move(column), {}, scales_});
  }
  /// An h5py bool.
  template <class Get>
  void flags(const std::string& name, std::string long_name, Get get) {
    codes(name, std::move(long_name), {"FALSE", "TRUE"},
          [get](const Item& item) { return static_cast<std::int64_t>(get(item) ? 1 : 0); });
  }
  /// The column put last becomes a scale of all that come after it.
  void last_is_scale(const std::string& name) {
    Dataset& last = out_.columns.back();
    last.scale_name = name;
    last.scales.clear();
    scales_.push_back(last.path);
  }

 private:
  template <class T, class Get>
  void put(const std::string& name, std::string units, std::string long_name, Get get) {
    std::vector<T> values;
    values.reserve(items_.size());
    for (const Item& item : items_) values.push_back(get(item));
    out_.columns.push_back(
        {group_ + "/" + name, {std::move(units), std::move(long_name)}, std::move(values), {}, scales_});
  }

  Datasets& out_;
  std::string group_;
  const std::vector<Item>& items_;
  std::vector<std::string> scales_;
};

std::int64_t code_of(Verdict verdict) {
  return std::find(verdicts.begin(), verdicts.end(), verdict) - verdicts.begin();
}

std::vector<std::string_view> verdict_names() {
  std::vector<std::string_view> names;
  for (const Verdict verdict : verdicts) names.push_back(to_string(verdict));
  return names;
}

std::string case_path(const CaseResult& result) { return "/cases/" + result.info.id; }

/// One scale for every name and unit that a row of the case gives a parameter.
void add_parameters(Columns<Row>& columns, const std::vector<Row>& rows) {
  const auto same_kind = [](const RowParameter& a, const RowParameter& b) {
    return a.name == b.name && a.unit == b.unit;
  };
  std::vector<RowParameter> kinds;
  for (const Row& row : rows) {
    for (const RowParameter& parameter : row.parameters) {
      const bool known =
          std::any_of(kinds.begin(), kinds.end(), [&](const RowParameter& kind) { return same_kind(kind, parameter); });
      if (!known) kinds.push_back(parameter);
    }
  }
  std::set<std::string> taken;
  for (const RowParameter& kind : kinds) {
    columns.numbers("parameter/" + untaken(taken, link_name(kind.name)), kind.unit, "parameter " + kind.name,
                    [&](const Row& row) {
                      for (const RowParameter& parameter : row.parameters) {
                        if (same_kind(kind, parameter)) return parameter.value;
                      }
                      return not_a_number;
                    });
    columns.last_is_scale(kind.name);
  }
}

void add_case(Datasets& out, const CaseResult& result) {
  const CaseInfo& info = result.info;
  out.groups.push_back({case_path(result),
                        {{"id", info.id},
                         {"family", info.family},
                         {"claim", info.claim},
                         {"physics", info.physics},
                         {"truth", info.truth},
                         {"rank", std::string(to_string(info.rank))},
                         {"grades", info.grades_metric ? "metric" : "stepper or harness"},
                         {"cites", info.cites},
                         {"source", info.source}}});
  Columns<Row> columns(out, case_path(result), result.rows);
  columns.texts("label", "what the row is, unique within its case", [](const Row& row) { return row.label; });
  columns.last_is_scale("label");
  add_parameters(columns, result.rows);
  columns.texts("metric", "metric id", [](const Row& row) { return row.metric; });
  columns.texts("chart", "chart id", [](const Row& row) { return row.chart; });
  columns.texts("method", "method id, with its projection; empty where nothing is stepped",
                [](const Row& row) { return row.method; });
  columns.numbers("setting", "1", "tolerance or step of the method; NaN where there is none",
                  [](const Row& row) { return row.setting > 0.0 ? row.setting : not_a_number; });
  const std::string unit = common_unit(result.rows, [](const Row& row) -> const std::string& { return row.unit; });
  columns.texts("unit", "unit of value, reference, errors and tolerance", [](const Row& row) { return row.unit; });
  const auto number = [&](const std::string& name, const std::string& long_name, double Row::*member) {
    columns.numbers(name, unit, long_name,
                    [member](const Row& row) { return measured(row) ? row.*member : not_a_number; });
  };
  number("value", "measured value", &Row::value);
  number("reference", "reference value", &Row::reference);
  number("reference_error", "absolute error of the reference itself", &Row::reference_error);
  number("error", "absolute error of the value", &Row::error);
  number("tolerance", "largest error that passes", &Row::tolerance);
  columns.texts("tolerance_reason", "why the tolerance is what it is",
                [](const Row& row) { return row.tolerance_reason; });
  columns.codes("verdict", "verdict", verdict_names(), [](const Row& row) { return code_of(row.verdict); });
  columns.integers("evaluations", "evaluations of the right-hand side", [](const Row& row) { return row.evaluations; });
  columns.texts("note", "why skipped or in error; what a reader should know", [](const Row& row) { return row.note; });
}

/// The points of one method in one chart, of one sweep.
struct Curve {
  std::string path;  ///< below /sweeps
  const Sweep* sweep = nullptr;
  std::vector<SweepPoint> points;
};

std::vector<Curve> curves_of(const SuiteResult& suite) {
  std::vector<Curve> curves;
  std::set<std::string> taken;
  for (const Sweep& sweep : suite.sweeps) {
    std::map<std::tuple<std::string, std::string, std::string>, std::size_t> known;
    for (const SweepPoint& point : sweep.points) {
      const auto [at, is_new] = known.try_emplace({point.metric, point.method, point.chart}, curves.size());
      if (is_new) {
        const std::string path = fmt::format("/{}/{}/{}/{}", link_name(point.metric), link_name(point.method),
                                             link_name(point.chart), link_name(sweep.quantity));
        curves.push_back({untaken(taken, path), &sweep, {}});
      }
      curves[at->second].points.push_back(point);
    }
  }
  return curves;
}

void add_curve(Datasets& out, const Curve& curve) {
  const SweepPoint& first = curve.points.front();
  const std::string& unit = curve.sweep->unit;
  out.groups.push_back({"/sweeps" + curve.path,
                        {{"quantity", curve.sweep->quantity},
                         {"rank", std::string(to_string(curve.sweep->rank))},
                         {"metric", first.metric},
                         {"chart", first.chart},
                         {"method", first.method},
                         {"control", first.adaptive ? "tolerance" : "step"}}});
  Columns<SweepPoint> columns(out, "/sweeps" + curve.path, curve.points);
  const auto number = [&columns](const std::string& name, const std::string& units, const std::string& long_name,
                                 double SweepPoint::*member) {
    columns.numbers(name, units, long_name, [member](const SweepPoint& point) { return point.*member; });
  };
  number("setting", "1", first.adaptive ? "tolerance" : "step in affine parameter", &SweepPoint::setting);
  columns.last_is_scale("setting");
  columns.integers("rays", "rays in the bundle", [](const SweepPoint& point) { return point.rays; });
  number("error_median", unit, "median error over the rays", &SweepPoint::error_median);
  number("error_p99", unit, "99th percentile of the error", &SweepPoint::error_p99);
  number("error_max", unit, "largest error", &SweepPoint::error_max);
  number("error_norm", unit, "root mean square error", &SweepPoint::error_norm);
  number("truth_error", unit, "absolute error of the truth itself", &SweepPoint::truth_error);
  number("null_drift_max", "1", "largest null residual along any ray", &SweepPoint::null_drift_max);
  number("evaluations_per_ray", "1", "evaluations of the right-hand side, per ray", &SweepPoint::evaluations_per_ray);
  number("steps_per_ray", "1", "accepted steps, per ray", &SweepPoint::steps_per_ray);
  number("observed_order", "1", "slope of the error between this point and the one before",
         &SweepPoint::observed_order);
  number("richardson_error", unit, "error estimated by Richardson extrapolation (GCI)", &SweepPoint::richardson_error);
  columns.texts("convergence", "class of convergence", [](const SweepPoint& point) { return point.convergence; });
}

void add_faults(Datasets& out, const std::vector<FaultResult>& faults) {
  out.groups.push_back({"/faults", {{"long_name", "faults planted on purpose, and what became of them"}}});
  Columns<FaultResult> columns(out, "/faults", faults);
  columns.texts("id", "fault id", [](const FaultResult& fault) { return fault.id; });
  columns.last_is_scale("id");
  columns.texts("description", "what is wrong", [](const FaultResult& fault) { return fault.description; });
  columns.texts("case", "case that was asked to catch it", [](const FaultResult& fault) { return fault.case_id; });
  columns.texts("row", "row with the largest error over tolerance", [](const FaultResult& fault) { return fault.row; });
  columns.numbers("error", "see the unit of the row", "error of that row",
                  [](const FaultResult& fault) { return fault.error; });
  columns.numbers("tolerance", "see the unit of the row", "tolerance of that row",
                  [](const FaultResult& fault) { return fault.tolerance; });
  columns.flags("twin_passed", "the unbroken case passed in the same run",
                [](const FaultResult& fault) { return fault.twin_passed; });
  columns.flags("caught", "verdict fail, finite error above 10 tolerances, twin passed",
                [](const FaultResult& fault) { return fault.caught; });
  columns.texts("note", "what a reader should know", [](const FaultResult& fault) { return fault.note; });
}

}  // namespace

Datasets result_datasets(const SuiteResult& suite) {
  Datasets out;
  out.groups.push_back({"/cases", {{"long_name", "graded rows, by family and case"}}});
  out.groups.push_back(
      {"/sweeps", {{"long_name", "convergence and work-precision, by metric, method, chart, quantity"}}});
  for (const CaseResult& result : suite.cases) add_case(out, result);
  for (const Curve& curve : curves_of(suite)) add_curve(out, curve);
  add_faults(out, suite.faults);
  return out;
}

Datasets timing_datasets(const SuiteResult& suite) {
  Datasets out;
  Columns<CaseResult> cases(out, "/volatile/cases", suite.cases);
  cases.texts("id", "case id", [](const CaseResult& result) { return result.info.id; });
  cases.last_is_scale("id");
  cases.numbers("seconds", "s", "wall time of the case", [](const CaseResult& result) { return result.seconds; });
  for (const Curve& curve : curves_of(suite)) {
    Columns<SweepPoint> columns(out, "/volatile/sweeps" + curve.path, curve.points);
    columns.numbers("seconds_per_ray", "s", "wall time per ray",
                    [](const SweepPoint& point) { return point.seconds_per_ray; });
  }
  return out;
}

Hashes hashes(const SuiteResult& suite) {
  CanonicalHash report;
  for (const Dataset& column : result_datasets(suite).columns) {
    DatasetHash& bytes = report.dataset(column.path);
    std::visit(
        [&bytes](const auto& values) {
          if constexpr (std::is_same_v<std::decay_t<decltype(values)>, EnumColumn>) {
            for (const std::int64_t code : values.codes) bytes.add(values.names[static_cast<std::size_t>(code)]);
          } else {
            for (const auto& value : values) bytes.add(value);
          }
        },
        column.values);
  }
  CanonicalHash rays;
  for (const CaseResult& result : suite.cases) {
    rays.dataset(case_path(result)).add(std::string_view(result.transported));
  }
  for (const Curve& curve : curves_of(suite)) {
    for (const SweepPoint& point : curve.points) {
      rays.dataset("/sweeps" + curve.path + "/null_drift_max").add(point.null_drift_max);
      rays.dataset("/sweeps" + curve.path + "/evaluations_per_ray").add(point.evaluations_per_ray);
      rays.dataset("/sweeps" + curve.path + "/steps_per_ray").add(point.steps_per_ray);
    }
  }
  return {report.hex(), rays.hex()};
}

void write_datasets(Hdf5File& file, const Datasets& datasets) {
  for (const GroupText& group : datasets.groups) {
    file.make_group(group.path);
    for (const auto& [name, value] : group.attributes) file.set_attribute(group.path, name, value);
  }
  for (const Dataset& column : datasets.columns) {
    std::visit(
        [&](const auto& values) {
          using Values = std::decay_t<decltype(values)>;
          if constexpr (std::is_same_v<Values, EnumColumn>) {
            file.write_enum(column.path, values.codes, values.names, column.text);
          } else {
            file.write(column.path, std::span<const typename Values::value_type>(values), column.text);
          }
        },
        column.values);
    if (!column.scale_name.empty()) file.make_scale(column.path, column.scale_name);
    for (const std::string& scale : column.scales) file.attach_scale(column.path, scale);
  }
}

}  // namespace xpr
