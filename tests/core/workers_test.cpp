#include "core/workers.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace xpr {
namespace {

TEST(Workers, visit_every_index_once) {
  for (const int threads : {0, 1, 2, 3}) {
    std::vector<int> visits(1003);
    Workers(threads).for_blocks(3, visits.size(), 10, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) ++visits[i];
    });
    for (std::size_t i = 0; i < visits.size(); ++i) ASSERT_EQ(visits[i], i < 3 ? 0 : 1) << i << ", " << threads;
  }
}

TEST(Workers, hand_on_what_a_block_throws) {
  Workers workers(2);
  const auto fail = [](std::size_t first, std::size_t) {
    if (first >= 50) throw std::runtime_error("block");
  };
  EXPECT_THROW(workers.for_blocks(0, 100, 1, fail), std::runtime_error);
  // And serve on.
  std::atomic<int> done{0};
  workers.for_blocks(0, 100, 1, [&](std::size_t first, std::size_t last) { done += static_cast<int>(last - first); });
  EXPECT_EQ(done, 100);
}

}  // namespace
}  // namespace xpr
