#include "core/repro.hpp"

#include <gtest/gtest.h>

namespace xpr {
namespace {

TEST(Repro, gives_one_hash_for_all_threads_and_lanes) {
  const std::vector<ReproRun> runs = run_repro({.rays = 96});
  ASSERT_EQ(runs.size(), 8U);
  for (const ReproRun& run : runs) {
    EXPECT_EQ(run.rays_hash, runs.front().rays_hash) << run.threads << " threads, " << run.lanes << " lanes";
  }
  EXPECT_TRUE(reproduced(runs));
}

TEST(Repro, sees_other_rays) {
  const std::vector<ReproRun> some = run_repro({.rays = 8, .threads = {1}, .lanes = {4}});
  const std::vector<ReproRun> more = run_repro({.rays = 9, .threads = {1}, .lanes = {4}});
  EXPECT_NE(some.front().rays_hash, more.front().rays_hash);
  EXPECT_FALSE(reproduced({some.front(), more.front()}));
}

}  // namespace
}  // namespace xpr
