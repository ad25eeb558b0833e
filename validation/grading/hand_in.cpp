#include "validation/grading/hand_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/io/errors.hpp"
#include "core/io/json.hpp"

namespace xpr {
namespace {

constexpr std::size_t block_rows = 16384;

// Where the columns stand in the schema.
struct In {
  static constexpr std::size_t id = 0, status = 1, sheet = 2, x = 3, p = 7, lambda = 11, steps = 12, rejected = 13,
                               evaluations = 14, seconds = 15;
};

/// One number of work for each ray, summed over the rows.
struct Work {
  double evaluations = 0.0, steps = 0.0, seconds = 0.0;
};

bool present(const TableBlock& block, std::size_t column) {
  return std::visit([](const auto& values) { return !values.empty(); }, block.columns[column]);
}

double sum_of(const TableBlock& block, std::size_t column) {
  double sum = 0.0;
  std::visit(
      [&](const auto& values) {
        for (const auto value : values) sum += static_cast<double>(value);
      },
      block.columns[column]);
  return sum;
}

class Reading {
 public:
  Reading(const std::filesystem::path& path, const ChallengeSet& set, std::int64_t count, const std::string& chart)
      : path_(path), set_(set), count_(count), reader_(open_table(path, hand_in_schema())) {
    hand_in_.file = path.filename().string();
    hand_in_.chart = chart;
    hand_in_.rays.resize(static_cast<std::size_t>(count));
    place_of_.assign(hand_in_.rays.size(), absent);
    agree("metric", std::string(set.metric));
    agree("chart", chart);
    agree_on_parameters();
  }

  HandIn run() {
    for (TableBlock block = reader_->read(block_rows); block.rows > 0; block = reader_->read(block_rows)) take(block);
    look_for_missing();
    set_work();
    return std::move(hand_in_);
  }

 private:
  static constexpr std::int64_t absent = -1;

  [[noreturn]] void fail(const std::string& what) const { throw InputError(path_.string() + ": " + what); }

  // An HDF5 table says what it holds.
  void agree(const std::string& name, const std::string& asked) const {
    const std::string own = reader_->attribute(name);
    if (own.empty() || own == asked) return;
    fail(fmt::format("holds rays of {} '{}', asked for is '{}'{}", name, own, asked,
                     name == "chart" ? "; --chart says in which they are" : ""));
  }

  void agree_on_parameters() const {
    const Json own = Json::parse(reader_->attribute("parameters"), nullptr, false);
    if (!own.is_object()) return;
    for (const NamedValue& parameter : set_.parameters) {
      const auto found = own.find(std::string(parameter.name));
      if (found == own.end() || !found->is_number() || found->get<double>() == parameter.value) continue;
      fail(fmt::format("holds rays of {} with {} = {}, set '{}' has {} = {}", set_.metric, parameter.name,
                       found->get<double>(), set_.id, parameter.name, parameter.value));
    }
  }

  [[nodiscard]] std::string place(const TableBlock& block, std::size_t row) const {
    return fmt::format("{} {}", reader_->place_word(), block.places[row]);
  }

  [[nodiscard]] std::size_t ray_of(const TableBlock& block, std::size_t row) {
    const std::int64_t id = block.integers(In::id)[row];
    const std::int64_t k = id - set_.first_id;
    if (k >= 0 && k < count_) return static_cast<std::size_t>(k);
    const ChallengeSet* other = set_of_id(id);
    if (other == &set_) {
      fail(fmt::format("{}: id {} is beyond the {} rays asked for, {} to {}; --count says how many there are",
                       place(block, row), id, count_, set_.first_id, set_.first_id + count_ - 1));
    }
    if (other != nullptr) {
      fail(fmt::format("{}: id {} belongs to set '{}', not to '{}'", place(block, row), id, other->id, set_.id));
    }
    fail(fmt::format("{}: id {} belongs to no set; those of '{}' are {} to {}", place(block, row), id, set_.id,
                     set_.first_id, set_.first_id + count_ - 1));
  }

  void check_columns(const TableBlock& block) const {
    for (std::size_t i = 1; i < 4; ++i) {
      if (present(block, In::p) != present(block, In::p + i)) fail("p0, p1, p2 and p3 come together or not at all");
    }
  }

  void take(const TableBlock& block) {
    check_columns(block);
    hand_in_.has_status = present(block, In::status);
    hand_in_.has_momentum = present(block, In::p);
    hand_in_.has_lambda = present(block, In::lambda);
    has_evaluations_ = present(block, In::evaluations);
    has_steps_ = present(block, In::steps);
    has_seconds_ = present(block, In::seconds);
    work_.evaluations += sum_of(block, In::evaluations);
    work_.steps += sum_of(block, In::steps) + sum_of(block, In::rejected);
    work_.seconds += sum_of(block, In::seconds);
    for (std::size_t row = 0; row < block.rows; ++row) take_row(block, row);
  }

  void take_row(const TableBlock& block, std::size_t row) {
    const std::size_t k = ray_of(block, row);
    if (place_of_[k] != absent) {
      fail(fmt::format("{}s {} and {} have the same id {}", reader_->place_word(), place_of_[k], block.places[row],
                       block.integers(In::id)[row]));
    }
    place_of_[k] = block.places[row];
    HandedRay& ray = hand_in_.rays[k];
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (hand_in_.has_status) ray.status = static_cast<Status>(block.integers(In::status)[row]);
    if (present(block, In::sheet)) ray.sheet = static_cast<int>(block.integers(In::sheet)[row]);
    if (ray.sheet != 1 && ray.sheet != -1) {
      fail(fmt::format("{}, column sheet: {}, needs 1 or -1", place(block, row), ray.sheet));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      ray.end[i] = block.reals(In::x + i)[row];
      ray.end[i + 4] = hand_in_.has_momentum ? block.reals(In::p + i)[row] : nan;
    }
    ray.lambda = hand_in_.has_lambda ? block.reals(In::lambda)[row] : nan;
  }

  /// A text file that ends within a line was cut off, or is written by hand.
  [[nodiscard]] bool ends_within_a_line() const {
    if (table_format(path_) != TableFormat::csv || !std::filesystem::is_regular_file(path_)) return false;
    std::ifstream in(path_, std::ios::binary | std::ios::ate);
    if (in.tellg() <= 0) return false;
    in.seekg(-1, std::ios::end);
    return in.get() != '\n';
  }

  void look_for_missing() const {
    const auto missing = std::count(place_of_.begin(), place_of_.end(), absent);
    if (missing == 0) return;
    std::string ids;
    std::int64_t named = 0;
    for (std::size_t k = 0; k < place_of_.size() && named < 5; ++k) {
      if (place_of_[k] != absent) continue;
      ids += fmt::format("{}{}", named++ > 0 ? ", " : "", set_.first_id + static_cast<std::int64_t>(k));
    }
    const bool cut = ends_within_a_line();
    const bool tail = std::find(place_of_.begin(), place_of_.end(), absent) == place_of_.end() - missing;
    const char* hint = cut    ? "; the file ends in the middle of a line: was it cut off?"
                       : tail ? "; all are at the end: was the file cut off, or made for another --count?"
                              : "; what a code cannot trace is a row of nan";
    fail(fmt::format("{} of the {} rays of '{}' are missing: {}{}{}", missing, count_, set_.id, ids,
                     missing > named ? ", ..." : "", hint));
  }

  void set_work() {
    const auto rays = static_cast<double>(std::max<std::size_t>(hand_in_.rays.size(), 1));
    hand_in_.work = std::numeric_limits<double>::quiet_NaN();
    if (has_evaluations_) {
      hand_in_.work = work_.evaluations / rays, hand_in_.work_unit = "evaluations";
    } else if (has_steps_) {
      hand_in_.work = work_.steps / rays, hand_in_.work_unit = "steps tried";
    } else if (has_seconds_) {
      hand_in_.work = work_.seconds / rays, hand_in_.work_unit = "seconds";
    }
  }

  const std::filesystem::path& path_;
  const ChallengeSet& set_;
  std::int64_t count_;
  std::unique_ptr<TableReader> reader_;
  HandIn hand_in_;
  std::vector<std::int64_t> place_of_;
  bool has_evaluations_ = false, has_steps_ = false, has_seconds_ = false;
  Work work_;
};

}  // namespace

TableSchema hand_in_schema() {
  const auto integer = [](const char* name, bool required) {
    return Column{.name = name, .type = ColumnType::integer, .required = required, .text = {}};
  };
  TableSchema schema{.group = "/rays", .columns = {integer("id", true)}};
  schema.columns.push_back(
      {.name = "status", .type = ColumnType::name, .required = false, .text = {}, .names = status_names});
  schema.columns.push_back(integer("sheet", false));
  for (const char* name : {"x0", "x1", "x2", "x3"}) schema.columns.push_back({.name = name, .text = {}});
  for (const char* name : {"p0", "p1", "p2", "p3", "lambda"}) {
    schema.columns.push_back({.name = name, .required = false, .text = {}});
  }
  for (const char* name : {"steps", "rejected", "evaluations"}) schema.columns.push_back(integer(name, false));
  for (const char* name : {"seconds", "null_residual", "null_residual_max"}) {
    schema.columns.push_back({.name = name, .required = false, .text = {}});
  }
  return schema;
}

HandIn read_hand_in(const std::filesystem::path& path, const ChallengeSet& set, std::int64_t count,
                    const std::string& chart) {
  return Reading(path, set, count, chart).run();
}

}  // namespace xpr
