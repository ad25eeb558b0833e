// The order conditions of Runge-Kutta methods, one for each rooted tree, over any number type.
//
// For a tree with subtrees t_1 ... t_m: u_i(t) = prod_k sum_j a_ij u_j(t_k), gamma(t) = |t| prod_k gamma(t_k); a method
// has order p if sum_i b_i u_i(t) = 1 / gamma(t) for every tree with |t| <= p nodes. Cites: [HairerNorsettWanner1993]
#pragma once

#include <cstddef>
#include <vector>

namespace xpr::test {

/// A rooted tree by its subtrees, which are earlier entries of the same list.
struct RootedTree {
  std::size_t order = 1;
  std::vector<std::size_t> subtrees;
};

namespace detail {
inline void extend(std::vector<RootedTree>& all, std::vector<std::size_t>& chosen, std::size_t rest,
                   std::size_t largest, std::size_t order) {
  if (rest == 0) {
    all.push_back({order, chosen});
    return;
  }
  for (std::size_t t = 0; t <= largest; ++t) {
    if (all[t].order > rest) continue;
    chosen.push_back(t);
    extend(all, chosen, rest - all[t].order, t, order);
    chosen.pop_back();
  }
}
}  // namespace detail

/// All rooted trees with up to `order` nodes: 1, 1, 2, 4, 9, 20, 48, 115, ... of each order.
inline std::vector<RootedTree> rooted_trees(std::size_t order) {
  std::vector<RootedTree> all{{1, {}}};
  for (std::size_t n = 2; n <= order; ++n) {
    const std::size_t smaller = all.size();
    std::vector<std::size_t> chosen;
    detail::extend(all, chosen, n - 1, smaller - 1, n);
  }
  return all;
}

template <class Number>
using Matrix = std::vector<std::vector<Number>>;

/// sum_i weight_i u_i(t) for every tree, beside gamma(t).
template <class Number>
struct TreeSum {
  std::size_t order;
  Number sum;
  Number gamma;
};

template <class Number>
std::vector<TreeSum<Number>> tree_sums(const Matrix<Number>& a, const std::vector<Number>& weight, std::size_t order) {
  const std::size_t stages = a.size();
  const std::vector<RootedTree> trees = rooted_trees(order);
  std::vector<std::vector<Number>> u;
  std::vector<TreeSum<Number>> out;
  for (const RootedTree& tree : trees) {
    std::vector<Number> value(stages, Number(1));
    Number gamma(static_cast<long>(tree.order));
    for (const std::size_t child : tree.subtrees) {
      gamma *= out[child].gamma;
      for (std::size_t i = 0; i < stages; ++i) {
        Number inner(0);
        for (std::size_t j = 0; j < stages; ++j) inner += a[i][j] * u[child][j];
        value[i] *= inner;
      }
    }
    Number sum(0);
    for (std::size_t i = 0; i < stages; ++i) sum += weight[i] * value[i];
    u.push_back(std::move(value));
    out.push_back({tree.order, sum, gamma});
  }
  return out;
}

}  // namespace xpr::test
