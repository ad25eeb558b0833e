#include "validation/truth/fifty_digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace xpr {

namespace flow50_detail {
template <std::size_t slice>
Rates50 flow_in_slice(std::string_view metric, std::string_view chart, std::span<const NamedValue> values);
extern template Rates50 flow_in_slice<0>(std::string_view, std::string_view, std::span<const NamedValue>);
extern template Rates50 flow_in_slice<1>(std::string_view, std::string_view, std::span<const NamedValue>);
extern template Rates50 flow_in_slice<2>(std::string_view, std::string_view, std::span<const NamedValue>);
extern template Rates50 flow_in_slice<3>(std::string_view, std::string_view, std::span<const NamedValue>);
}  // namespace flow50_detail

namespace {

using State = std::vector<Real50>;

/// The largest |x - y| relative to 1 + |y|, or an infinity where a number is not finite.
Real50 distance(const State& x, const State& y) {
  Real50 largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Real50 d = abs(x[i] - y[i]) / (1 + abs(y[i]));
    if (!(d <= largest)) largest = d;
    if (!isfinite(d)) return Real50(std::numeric_limits<double>::infinity());
  }
  return largest;
}

/// One system, and the work that its steps cost.
class Extrapolation {
 public:
  Extrapolation(const Rates50& rates, int columns) : rates_(rates), columns_(columns) {}

  /// y after h; the change that the last column made is left in `change`.
  [[nodiscard]] State step(const State& y, const Real50& h, Real50& change) {
    begin_.resize(y.size());
    rate(y, begin_);
    // Aitken and Neville: row j holds T(j, 0), T(j, 1), ... with n_j = 2 (j + 1) steps of the rule.
    std::vector<State> last, row;
    for (int j = 0; j < columns_; ++j) {
      row.assign(1, midpoint(y, h, 2 * (j + 1)));
      for (int k = 0; k < j; ++k) {
        const Real50 ratio = Real50(j + 1) / (j - k);
        const Real50 weight = 1 / (ratio * ratio - 1);
        State next = row.back();
        for (std::size_t i = 0; i < y.size(); ++i) next[i] += (next[i] - last[static_cast<std::size_t>(k)][i]) * weight;
        row.push_back(std::move(next));
      }
      std::swap(last, row);
    }
    change = distance(last[last.size() - 2], last.back());
    return last.back();
  }

  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  void rate(const State& y, State& out) {
    rates_(y, out);
    ++evaluations_;
  }

  /// Gragg's rule with n steps, n even, without the smoothing that extrapolation does not need.
  [[nodiscard]] State midpoint(const State& y, const Real50& h, int n) {
    const Real50 part = h / n;
    State before = y, now = y, slope(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) now[i] += part * begin_[i];
    for (int m = 1; m < n; ++m) {
      rate(now, slope);
      for (std::size_t i = 0; i < y.size(); ++i) before[i] += 2 * part * slope[i];
      std::swap(before, now);
    }
    return now;
  }

  const Rates50& rates_;
  int columns_;
  State begin_;
  std::int64_t evaluations_ = 0;
};

/// How much longer the next step may be, by a change that goes as h^(2 k - 1).
double growth(const Real50& change, const ExtrapolationSettings& settings) {
  if (change == 0) return 4.0;
  const double ratio = static_cast<double>(log(Real50(settings.tol) / change));
  return std::clamp(0.85 * std::exp(ratio / (2.0 * settings.columns - 1.0)), 0.1, 4.0);
}

/// Where an integration stands, and how long a step it may try next.
class Walk {
 public:
  Walk(const Rates50& rates, State start, Real50 first_step, const ExtrapolationSettings& settings)
      : settings_(settings), method_(rates, settings.columns), h_(std::move(first_step)), least_(abs(h_) * 1e-9) {
    path_.y = std::move(start);
    path_.at = 0;
  }

  /// The state after one step that the tolerance accepts, no longer than `most`; `taken` is its length. Throws where
  /// steps become too short.
  [[nodiscard]] State advance(const Real50& most, Real50& taken) {
    for (;;) {
      taken = abs(most) < abs(h_) ? most : h_;
      Real50 change;
      State next = method_.step(path_.y, taken, change);
      const double factor = isfinite(change) ? growth(change, settings_) : 0.1;
      const bool accepted = change <= settings_.tol;
      if (!accepted || taken == h_) h_ = taken * factor;
      if (accepted && taken == most) return next;
      // Good steps too: towards a pole each is a part of the way that is left.
      if (abs(h_) < least_) {
        throw std::runtime_error(fmt::format("50 digits: the step falls to {:.3g} at {:.6g}", static_cast<double>(h_),
                                             static_cast<double>(path_.at)));
      }
      if (accepted) return next;
    }
  }
  void accept(State next, const Real50& taken) {
    path_.y = std::move(next);
    path_.at += taken;
    ++path_.steps;
  }
  /// A step of any length from where the walk stands, without going there.
  [[nodiscard]] State tried(const Real50& h) {
    Real50 ignored;
    return method_.step(path_.y, h, ignored);
  }
  [[nodiscard]] const Path50& path() const { return path_; }
  [[nodiscard]] Path50 finished() {
    path_.evaluations = method_.evaluations();
    return std::move(path_);
  }

 private:
  ExtrapolationSettings settings_;
  Extrapolation method_;
  Path50 path_;
  Real50 h_;
  Real50 least_;
};

}  // namespace

Path50 integrate50(const Rates50& rates, std::vector<Real50> start, const Real50& until,
                   const ExtrapolationSettings& settings) {
  Walk walk(rates, std::move(start), until / 16, settings);
  for (;;) {
    const Real50 left = until - walk.path().at;
    if (left == 0) return walk.finished();
    Real50 taken;
    State next = walk.advance(left, taken);
    walk.accept(std::move(next), taken);
  }
}

Path50 integrate50_to(const Rates50& rates, std::vector<Real50> start,
                      const std::function<Real50(const std::vector<Real50>& y)>& surface, int direction,
                      const Real50& first_step, const Real50& most, const ExtrapolationSettings& settings) {
  Walk walk(rates, std::move(start), first_step, settings);
  Real50 before = surface(walk.path().y);
  while (abs(walk.path().at) < abs(most)) {
    Real50 taken;
    State next = walk.advance(most, taken);
    const Real50 after = surface(next);
    if (!(direction * after >= 0 && direction * before < 0)) {
      walk.accept(std::move(next), taken);
      before = after;
      continue;
    }
    // Secants between the step's ends; each trial is a whole step of its own, so that no interpolant enters.
    Real50 low = 0, high = taken, at_low = before, at_high = after;
    for (int i = 0; i < 60 && abs(high - low) > settings.tol * abs(taken) && at_high != at_low; ++i) {
      const Real50 guess = high - at_high * (high - low) / (at_high - at_low);
      low = high, at_low = at_high;
      high = guess;
      next = walk.tried(high);
      at_high = surface(next);
    }
    walk.accept(std::move(next), high);
    return walk.finished();
  }
  throw std::runtime_error("50 digits: the surface is not met");
}

Twice50 integrate50_twice(const Rates50& rates, const std::vector<Real50>& start, const Real50& until) {
  return {integrate50(rates, start, until).y, integrate50(rates, start, until, {.columns = 14, .tol = 1e-43}).y};
}

Rates50 flow50(std::string_view metric, std::string_view chart, std::span<const NamedValue> values) {
  using namespace flow50_detail;
  for (const auto in_slice : {flow_in_slice<0>, flow_in_slice<1>, flow_in_slice<2>, flow_in_slice<3>}) {
    if (Rates50 found = in_slice(metric, chart, values)) return found;
  }
  throw std::invalid_argument(fmt::format("50 digits: no metric module '{}' in chart '{}'", metric, chart));
}

}  // namespace xpr
