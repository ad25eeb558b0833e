// Coefficients against the order conditions: exactly where they are fractions.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <string>

#include "integrators/butcher_tableau.hpp"
#include "integrators/dop853_coefficients.hpp"
#include "integrators/gauss_legendre.hpp"
#include "order_conditions.hpp"

namespace xpr {
namespace {

using test::Matrix;
using Rational = boost::multiprecision::cpp_rational;
using Precise = boost::multiprecision::cpp_bin_float_50;

struct NamedTableau {
  std::string name;
  const ButcherTableau& tableau;
  std::size_t order;
  std::size_t embedded_order;
};

const std::vector<NamedTableau> all_tableaux{{"euler", tableaux::euler, 1, 0}, {"midpoint", tableaux::midpoint, 2, 0},
                                             {"heun2", tableaux::heun2, 2, 0}, {"rk4", tableaux::rk4, 4, 0},
                                             {"rkf45", tableaux::rkf45, 5, 4}, {"dopri54", tableaux::dopri54, 5, 4}};

Rational exact(const Fraction& f) { return Rational(f.numerator, f.denominator); }

Matrix<Rational> matrix_of(const ButcherTableau& tableau) {
  Matrix<Rational> a(tableau.stages, std::vector<Rational>(tableau.stages));
  for (std::size_t i = 0; i < tableau.stages; ++i) {
    for (std::size_t j = 0; j < tableau.stages; ++j) a[i][j] = exact(tableau.a[i][j]);
  }
  return a;
}

std::vector<Rational> weights_of(const ButcherTableau& tableau, const ButcherTableau::Row& row) {
  std::vector<Rational> out;
  for (std::size_t i = 0; i < tableau.stages; ++i) out.push_back(exact(row[i]));
  return out;
}

/// The order up to which sum = theta^|t| / gamma holds exactly for every tree.
std::size_t exact_order(const Matrix<Rational>& a, const std::vector<Rational>& weight, std::size_t up_to,
                        const Rational& theta = 1) {
  std::size_t order = up_to;
  for (const auto& t : test::tree_sums(a, weight, up_to)) {
    Rational power = 1;
    for (std::size_t n = 0; n < t.order; ++n) power *= theta;
    if (t.sum * t.gamma != power) order = std::min(order, t.order - 1);
  }
  return order;
}

TEST(RootedTrees, are_as_many_as_cayley_counted) {
  const std::vector<test::RootedTree> trees = test::rooted_trees(8);
  std::vector<std::size_t> count(9);
  for (const auto& tree : trees) ++count[tree.order];
  EXPECT_EQ(count, (std::vector<std::size_t>{0, 1, 1, 2, 4, 9, 20, 48, 115}));
}

TEST(ButcherTableaux, have_their_order_exactly_and_no_more) {
  for (const NamedTableau& t : all_tableaux) {
    const Matrix<Rational> a = matrix_of(t.tableau);
    EXPECT_EQ(exact_order(a, weights_of(t.tableau, t.tableau.b), t.order + 1), t.order) << t.name;
    if (t.tableau.embedded) {
      EXPECT_EQ(exact_order(a, weights_of(t.tableau, t.tableau.b_embedded), t.order), t.embedded_order) << t.name;
    }
  }
}

TEST(ButcherTableaux, have_nodes_that_are_their_row_sums) {
  for (const NamedTableau& t : all_tableaux) {
    for (std::size_t i = 0; i < t.tableau.stages; ++i) {
      Rational sum = 0;
      for (const Fraction& f : t.tableau.a[i]) sum += exact(f);
      EXPECT_EQ(sum, exact(t.tableau.c[i])) << t.name << " row " << i;
      for (std::size_t j = i; j < ButcherTableau::max_stages; ++j) {
        EXPECT_EQ(t.tableau.a[i][j].numerator, 0) << t.name << " is explicit: row " << i << " column " << j;
      }
    }
  }
}

TEST(ButcherTableaux, dormand_prince_ends_on_its_last_stage) {
  const ButcherTableau& t = tableaux::dopri54;
  for (std::size_t j = 0; j < t.stages; ++j) EXPECT_EQ(exact(t.a[6][j]), exact(t.b[j])) << j;
}

/// Weights at theta of the cubic Hermite interpolant plus theta^2 (1 - theta)^2 bump.
template <class Number>
std::vector<Number> dense_weights(const std::vector<Number>& b, std::size_t last, const std::vector<Number>& bump,
                                  const Number& theta) {
  const Number rest = 1 - theta;
  std::vector<Number> w;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Number at_begin = (i == 0 ? Number(1) : Number(0)) - b[i];
    const Number at_end = (i == last ? Number(1) : Number(0)) - b[i];
    w.push_back(theta * b[i] + theta * rest * (rest * at_begin - theta * at_end) +
                theta * theta * rest * rest * bump[i]);
  }
  return w;
}

TEST(ButcherTableaux, dormand_prince_has_dense_output_of_order_4_at_any_point) {
  const ButcherTableau& t = tableaux::dopri54;
  for (const Rational& theta : {Rational(1, 3), Rational(3, 7), Rational(9, 10)}) {
    const auto w = dense_weights<Rational>(weights_of(t, t.b), 6, weights_of(t, t.d), theta);
    EXPECT_EQ(exact_order(matrix_of(t), w, 5, theta), 4U) << theta;
  }
}

TEST(ButcherTableaux, lose_their_order_when_one_coefficient_is_off_by_one_digit) {
  for (const NamedTableau& t : all_tableaux) {
    for (std::size_t i = 0; i < t.tableau.stages; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        ButcherTableau wrong = t.tableau;
        if (wrong.a[i][j].numerator == 0) continue;
        wrong.a[i][j].numerator += 1;
        Rational sum = 0;
        for (const Fraction& f : wrong.a[i]) sum += exact(f);
        EXPECT_NE(sum, exact(wrong.c[i])) << t.name;
      }
      ButcherTableau wrong = t.tableau;
      wrong.b[i].numerator += 1;
      EXPECT_LT(exact_order(matrix_of(wrong), weights_of(wrong, wrong.b), t.order), t.order) << t.name << " b " << i;
    }
  }
}

Matrix<Precise> dop853_matrix(std::size_t stages) {
  Matrix<Precise> a(stages, std::vector<Precise>(stages));
  for (std::size_t i = 0; i < stages; ++i) {
    for (std::size_t j = 0; j < i; ++j) a[i][j] = Precise(dop853::a[i][j]);
  }
  return a;
}

std::vector<Precise> dop853_weights(const dop853::Row& row, std::size_t stages) {
  std::vector<Precise> w;
  for (std::size_t i = 0; i < stages; ++i) w.push_back(Precise(row[i]));
  return w;
}

/// The largest violation among trees of the given orders.
double violation(const Matrix<Precise>& a, const std::vector<Precise>& w, std::size_t from, std::size_t to,
                 const Precise& theta, bool homogeneous = false) {
  Precise largest = 0;
  for (const auto& t : test::tree_sums(a, w, to)) {
    if (t.order < from) continue;
    Precise power = homogeneous ? 0 : 1;
    for (std::size_t n = 0; n < t.order; ++n) power *= theta;
    const Precise off = abs(t.sum - power / t.gamma);
    if (off > largest) largest = off;
  }
  return static_cast<double>(largest);
}

// Coefficients are doubles: each sum of up to a dozen terms of size up to 60 is known to some 1e-15 at best, 5e-15 over
// the products in the trees. A digit wrong anywhere in the first thirteen shows.
constexpr double dop853_round_off = 5e-15;

TEST(Dop853, has_order_8) {
  const auto b = dop853_weights(dop853::a[12], 12);
  EXPECT_LT(violation(dop853_matrix(12), b, 1, 8, 1), dop853_round_off);
}

TEST(Dop853, has_error_estimates_of_orders_5_and_3) {
  const auto a = dop853_matrix(12);
  const auto fifth = dop853_weights(dop853::error5, 12);
  const auto third = dop853_weights(dop853::error3, 12);
  EXPECT_LT(violation(a, fifth, 1, 5, 1, true), dop853_round_off);
  EXPECT_GT(violation(a, fifth, 6, 6, 1, true), 1e-6);
  EXPECT_LT(violation(a, third, 1, 3, 1, true), dop853_round_off);
  EXPECT_GT(violation(a, third, 4, 4, 1, true), 1e-6);
}

TEST(Dop853, has_nodes_that_are_its_row_sums) {
  for (std::size_t i = 0; i < dop853::dense_stages; ++i) {
    Precise sum = 0;
    for (std::size_t j = 0; j < dop853::dense_stages; ++j) sum += Precise(dop853::a[i][j]);
    EXPECT_LT(abs(sum - Precise(dop853::c[i])), dop853_round_off) << i;
  }
}

TEST(Dop853, has_dense_output_of_order_7_at_any_point) {
  const auto b = dop853_weights(dop853::a[12], 16);
  for (const double theta : {0.2, 0.5, 0.9}) {
    std::vector<Precise> bump;
    for (std::size_t i = 0; i < 16; ++i) {
      bump.push_back(Precise(dop853::d[0][i]) +
                     theta * (Precise(dop853::d[1][i]) +
                              (1 - theta) * (Precise(dop853::d[2][i]) + theta * Precise(dop853::d[3][i]))));
    }
    const auto w = dense_weights<Precise>(b, 12, bump, Precise(theta));
    // The dense weights reach 500: their round-off, times theta^2 (1 - theta)^2 <= 1/16.
    EXPECT_LT(violation(dop853_matrix(16), w, 1, 7, Precise(theta)), 2e-14) << theta;
    EXPECT_GT(violation(dop853_matrix(16), w, 8, 8, Precise(theta)), 1e-9) << theta;
  }
}

template <std::size_t S>
void expect_gauss(const GaussCoefficients<S>& method) {
  Matrix<Precise> a(S, std::vector<Precise>(S));
  std::vector<Precise> b;
  for (std::size_t i = 0; i < S; ++i) {
    b.push_back(Precise(method.b[i]));
    for (std::size_t j = 0; j < S; ++j) {
      a[i][j] = Precise(method.mu[i][j]) * Precise(method.b[j]);
      EXPECT_EQ(method.mu[i][j] + method.mu[j][i], 1.0) << "symplectic to the bit: " << i << ", " << j;
    }
  }
  EXPECT_LT(violation(a, b, 1, 2 * S, 1), 1e-15) << S;
  EXPECT_GT(violation(a, b, 2 * S + 1, 2 * S + 1, 1), 1e-6) << S;
}

TEST(GaussLegendre, has_twice_the_order_of_its_stages_and_symplectic_weights) {
  expect_gauss(gauss::one_stage);
  expect_gauss(gauss::two_stages);
  expect_gauss(gauss::three_stages);
}

}  // namespace
}  // namespace xpr
