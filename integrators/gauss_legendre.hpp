// Gauss-Legendre collocation with one, two and three stages: the implicit midpoint rule, order 4 and order 6.
// Symplectic and symmetric for every Hamiltonian.
//
//   L_i = h b_i f(Y_i),   Y_i = y + sum_j mu_ij L_j,   y' = y + sum_i L_i
//
// with mu_ij = a_ij / b_j. Symplectic means mu_ij + mu_ji = 1, which holds here to the bit, so that the step map stays
// symplectic however b is rounded. Sums over steps carry their round-off along. The stages are found by fixed-point
// iteration until nothing changes any more: stopping earlier gives an energy drift that grows linearly.
// Cites: [HairerLubichWanner2006] [AntonanaMakazagaMurua2017]
#pragma once

#include <array>
#include <cstddef>

#include "integrators/carried_state.hpp"
#include "integrators/flow_stepper.hpp"
#include "metrics/scalar/dual.hpp"

namespace xpr {

template <std::size_t S>
struct GaussCoefficients {
  std::array<double, S> b{};
  std::array<std::array<double, S>, S> mu{};
};

namespace gauss {

// mu_ij above the diagonal is 1 - mu_ji: exact, since each mu_ji lies between 1/2 and 2.
inline constexpr GaussCoefficients<1> one_stage{{1.0}, {{{0.5}}}};

inline constexpr double mu21_of_two = 1.0773502691896257645;  // 1/2 + sqrt(3)/3
inline constexpr GaussCoefficients<2> two_stages{{0.5, 0.5}, {{{0.5, 1.0 - mu21_of_two}, {mu21_of_two, 0.5}}}};

inline constexpr double mu21_of_three = 1.0809475019311125640;  // 1/2 + 3 sqrt(15)/20
inline constexpr double mu31_of_three = 0.9647580015448900512;  // 1/2 + 3 sqrt(15)/25
inline constexpr GaussCoefficients<3> three_stages{{5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0},
                                                   {{{0.5, 1.0 - mu21_of_three, 1.0 - mu31_of_three},
                                                     {mu21_of_three, 0.5, 1.0 - mu21_of_three},
                                                     {mu31_of_three, mu21_of_three, 0.5}}}};

/// Calls f(part) for the value and every derivative of a scalar.
template <class F>
constexpr void for_each_part(double x, const F& f) {
  f(x);
}
template <class T, int N, class F>
constexpr void for_each_part(const Dual<T, N>& x, const F& f) {
  for_each_part(x.value, f);
  for (const T& d : x.derivative) for_each_part(d, f);
}

template <class T>
inline constexpr std::size_t parts = 1;
template <class T, int N>
inline constexpr std::size_t parts<Dual<T, N>> = parts<T>*(N + 1);

/// Watches a fixed-point iteration: it has settled when no part of any component moves, or when round-off keeps the
/// last of them moving and none comes nearer.
template <std::size_t Components>
class Settling {
 public:
  void begin_iteration() {
    next_ = 0;
    moving_ = improving_ = false;
    largest_move_ = largest_value_ = 0.0;
  }
  void see(double before, double now) {
    const double move = before < now ? now - before : before - now;
    const double size = now < 0.0 ? -now : now;
    if (!(move <= largest_move_)) largest_move_ = move;
    if (size > largest_value_) largest_value_ = size;
    if (move != 0.0) moving_ = true;
    if (move != 0.0 && move < least_move_[next_]) {
      least_move_[next_] = move;
      improving_ = true;
    }
    ++next_;
  }
  /// An iteration that stands still far above round-off diverges; it has not settled.
  [[nodiscard]] bool settled() const { return !moving_ || (!improving_ && largest_move_ <= 1e-9 * largest_value_); }
  Settling() { least_move_.fill(1e308); }

 private:
  std::array<double, Components> least_move_;
  std::size_t next_ = 0;
  bool moving_ = false, improving_ = false;
  double largest_move_ = 0.0, largest_value_ = 0.0;
};

/// One step from y, whose flow is `rate`; `rest` is the round-off carried along. False if the iteration did not settle.
template <std::size_t S, class T, class FlowT>
[[nodiscard]] bool step(const GaussCoefficients<S>& method, FlowT&& flow, const PhaseState<T>& y,
                        const PhaseState<T>& rate, double h, int max_iterations, PhaseState<T>& rest,
                        PhaseState<T>& y_next) {
  std::array<PhaseState<T>, S> L;
  for (std::size_t s = 0; s < S; ++s) {
    for (std::size_t i = 0; i < 8; ++i) L[s][i] = (h * method.b[s]) * rate[i];
  }
  std::array<PhaseState<T>, S> Y;
  Settling<8 * S * parts<T>> settling;
  bool settled = false;
  for (int iteration = 0; iteration < max_iterations && !settled; ++iteration) {
    settling.begin_iteration();
    for (std::size_t s = 0; s < S; ++s) {
      const PhaseState<T> before = Y[s];
      for (std::size_t i = 0; i < 8; ++i) {
        T sum = rest[i];
        for (std::size_t j = 0; j < S; ++j) sum = sum + method.mu[s][j] * L[j][i];
        Y[s][i] = y[i] + sum;
        std::array<double, parts<T>> old{};
        std::size_t k = 0;
        for_each_part(before[i], [&](double part) { old[k++] = part; });
        k = 0;
        for_each_part(Y[s][i], [&](double part) {
          settling.see(iteration == 0 ? 1e308 : old[k], part);
          ++k;
        });
      }
    }
    settled = iteration > 0 && settling.settled();
    if (settled) break;
    for (std::size_t s = 0; s < S; ++s) {
      const PhaseState<T> f = flow(Y[s]);
      for (std::size_t i = 0; i < 8; ++i) L[s][i] = (h * method.b[s]) * f[i];
    }
  }
  for (std::size_t i = 0; i < 8; ++i) {
    T sum = L[0][i];
    for (std::size_t j = 1; j < S; ++j) sum = sum + L[j][i];
    y_next[i] = add_compensated(y[i], sum, rest[i]);
  }
  return settled;
}

}  // namespace gauss

/// A Gauss-Legendre method behind the stepper interface.
template <std::size_t S>
class GaussStepper final : public FlowStepper {
 public:
  GaussStepper(const MethodCard& card, const GaussCoefficients<S>& method, Flow flow, int max_iterations)
      : FlowStepper(card, std::move(flow)), method_(method), max_iterations_(max_iterations) {}

  [[nodiscard]] StepOutcome step(const PhaseState<double>& y, double h) override {
    begin_step(y, h);
    PhaseState<double> rest = rest_.at(y, {});
    StepOutcome out;
    out.converged = gauss::step(method_, counted_flow(), y, begin_rate(), h, max_iterations_, rest, out.y);
    rest_.set_end(out.y, rest);
    end_step(out.y);
    return out;
  }

 private:
  GaussCoefficients<S> method_;
  int max_iterations_;
  CarriedState<PhaseState<double>> rest_;
};

}  // namespace xpr
