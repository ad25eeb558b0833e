// Explicit Runge-Kutta methods as data: exact fractions, so that tests can check the order conditions exactly.
//
//   k_i = f(y + h sum_j a_ij k_j),   y' = y + h sum_i b_i k_i,   error estimate h sum_i (b_i - bhat_i) k_i
//
// Nodes c_i are the row sums of a; an autonomous flow does not need them, tests check them. Dense output, where a
// tableau brings its own, is the cubic Hermite interpolant plus theta^2 (1 - theta)^2 h sum_i d_i k_i.
// Cites: [HairerNorsettWanner1993] [Fehlberg1969] [DormandPrince1980] [Shampine1986]
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace xpr {

struct Fraction {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;

  [[nodiscard]] constexpr double value() const {
    // Both below 2^53 in every tableau here: the quotient is correctly rounded.
    return static_cast<double>(numerator) / static_cast<double>(denominator);
  }
};

struct ButcherTableau {
  static constexpr std::size_t max_stages = 7;
  using Row = std::array<Fraction, max_stages>;

  std::size_t stages = 0;
  std::array<Row, max_stages> a{};
  Row b{};
  Row c{};
  bool embedded = false;
  Row b_embedded{};
  bool first_same_as_last = false;  ///< the last stage is taken at the end point: row `stages - 1` of a equals b
  bool dense = false;
  Row d{};
};

namespace tableaux {

inline constexpr ButcherTableau euler{.stages = 1, .b = {{{1}}}};

inline constexpr ButcherTableau midpoint{.stages = 2, .a = {{{}, {{{1, 2}}}}}, .b = {{{0}, {1}}}, .c = {{{0}, {1, 2}}}};

/// Heun's method of order 2, the explicit trapezoidal rule.
inline constexpr ButcherTableau heun2{.stages = 2, .a = {{{}, {{{1}}}}}, .b = {{{1, 2}, {1, 2}}}, .c = {{{0}, {1}}}};

/// The classical method of Kutta.
inline constexpr ButcherTableau rk4{.stages = 4,
                                    .a = {{{}, {{{1, 2}}}, {{{0}, {1, 2}}}, {{{0}, {0}, {1}}}}},
                                    .b = {{{1, 6}, {1, 3}, {1, 3}, {1, 6}}},
                                    .c = {{{0}, {1, 2}, {1, 2}, {1}}}};

/// Fehlberg's 4(5) pair; the fifth order result is propagated (local extrapolation).
inline constexpr ButcherTableau rkf45{.stages = 6,
                                      .a = {{{},
                                             {{{1, 4}}},
                                             {{{3, 32}, {9, 32}}},
                                             {{{1932, 2197}, {-7200, 2197}, {7296, 2197}}},
                                             {{{439, 216}, {-8}, {3680, 513}, {-845, 4104}}},
                                             {{{-8, 27}, {2}, {-3544, 2565}, {1859, 4104}, {-11, 40}}}}},
                                      .b = {{{16, 135}, {0}, {6656, 12825}, {28561, 56430}, {-9, 50}, {2, 55}}},
                                      .c = {{{0}, {1, 4}, {3, 8}, {12, 13}, {1}, {1, 2}}},
                                      .embedded = true,
                                      .b_embedded = {{{25, 216}, {0}, {1408, 2565}, {2197, 4104}, {-1, 5}}}};

/// Dormand and Prince's 5(4) pair with Shampine's dense output of order 4.
inline constexpr ButcherTableau dopri54{
    .stages = 7,
    .a = {{{},
           {{{1, 5}}},
           {{{3, 40}, {9, 40}}},
           {{{44, 45}, {-56, 15}, {32, 9}}},
           {{{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}}},
           {{{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}},
           {{{35, 384}, {0}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}}}}},
    .b = {{{35, 384}, {0}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}}},
    .c = {{{0}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1}, {1}}},
    .embedded = true,
    .b_embedded = {{{5179, 57600}, {0}, {7571, 16695}, {393, 640}, {-92097, 339200}, {187, 2100}, {1, 40}}},
    .first_same_as_last = true,
    .dense = true,
    .d = {{{-12715105075, 11282082432},
           {0},
           {87487479700, 32700410799},
           {-10690763975, 1880347072},
           {701980252875, 199316789632},
           {-1453857185, 822651844},
           {69997945, 29380423}}}};

}  // namespace tableaux
}  // namespace xpr
