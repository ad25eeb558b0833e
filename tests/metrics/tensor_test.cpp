#include "metrics/tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace xpr {
namespace {

TEST(SymTensor4, stores_each_pair_once_whatever_the_order_of_indices) {
  SymTensor4<double> g;
  double value = 1.0;
  for (std::size_t mu = 0; mu < 4; ++mu) {
    for (std::size_t nu = mu; nu < 4; ++nu) g(mu, nu) = value++;
  }
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(g.c[i], static_cast<double>(i + 1));
  for (std::size_t mu = 0; mu < 4; ++mu) {
    for (std::size_t nu = 0; nu < 4; ++nu) EXPECT_EQ(g(mu, nu), g(nu, mu));
  }
}

TEST(SymTensor4, inverse_times_itself_is_the_identity) {
  // A metric with every component present: Minkowski plus a generic symmetric part of order one.
  SymTensor4<double> g = diagonal(-1.3, 1.1, 1.7, 0.9);
  g(0, 1) = 0.31, g(0, 2) = -0.22, g(0, 3) = 0.17, g(1, 2) = 0.41, g(1, 3) = -0.13, g(2, 3) = 0.29;
  const SymTensor4<double> h = inverse(g);
  for (std::size_t mu = 0; mu < 4; ++mu) {
    for (std::size_t nu = 0; nu < 4; ++nu) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k) sum += g(mu, k) * h(k, nu);
      // About twenty products of order one, condition number below ten: 1e-14 is 50 units of round-off.
      EXPECT_NEAR(sum, mu == nu ? 1.0 : 0.0, 1e-14);
    }
  }
}

}  // namespace
}  // namespace xpr
