#include "validation/frame_difference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace xpr {
namespace {

FilmFrame frame_of(int columns, int rows) {
  FilmFrame frame;
  frame.columns = columns;
  frame.rows = rows;
  const auto pixels = static_cast<std::size_t>(columns * rows);
  for (const char* name : {"R", "G", "B", "depth", "class"}) {
    frame.planes.push_back({name, "1", name, std::vector<double>(pixels, 0.0)});
  }
  return frame;
}

TEST(FrameDifference, counts_what_moved_and_by_how_many_doubles) {
  const FilmFrame before = frame_of(4, 3);
  FilmFrame after = before;
  EXPECT_TRUE(compare_frames(before, after).unchanged());
  after.planes[3].values[5] = 3 * std::numeric_limits<double>::denorm_min();
  after.planes[3].values[7] = 0.25;
  after.planes[4].values[7] = 2.0;
  const FrameDifference difference = compare_frames(before, after);
  EXPECT_FALSE(difference.unchanged());
  ASSERT_EQ(difference.planes.size(), 2U);
  EXPECT_EQ(difference.planes[0].name, "depth");
  EXPECT_EQ(difference.planes[0].pixels, 2);
  EXPECT_EQ(difference.planes[0].first, 5U);
  EXPECT_EQ(difference.planes[0].most, 0.25);
  ASSERT_EQ(difference.classes.size(), 1U);
  EXPECT_EQ(difference.classes[0].before, 0U);
  EXPECT_EQ(difference.classes[0].after, 2U);
  EXPECT_EQ(difference.classes[0].pixels, 1);
  EXPECT_EQ(std::count(difference.moved.begin(), difference.moved.end(), 1), 2);
  EXPECT_EQ(difference.mean_colour, 0.0);
}

TEST(FrameDifference, not_a_number_equals_itself_and_nothing_else) {
  FilmFrame before = frame_of(2, 2), after = frame_of(2, 2);
  before.planes[3].values[1] = after.planes[3].values[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(compare_frames(before, after).unchanged());
  after.planes[3].values[0] = std::numeric_limits<double>::quiet_NaN();
  after.planes[3].values[2] = 1.0;
  const FrameDifference difference = compare_frames(before, after);
  EXPECT_EQ(difference.planes.front().pixels, 2);
  EXPECT_TRUE(std::isnan(difference.planes.front().most));
}

TEST(FrameDifference, the_colour_is_compared_as_a_screen_shows_it) {
  const FilmFrame before = frame_of(2, 1);
  FilmFrame after = before;
  after.planes[0].values[0] = 1.0;
  // One of six bytes goes from 0 to 255.
  EXPECT_DOUBLE_EQ(compare_frames(before, after).mean_colour, 255.0 / 6.0);
}

TEST(FrameDifference, planes_of_one_frame_only_are_named_and_sizes_must_agree) {
  const FilmFrame before = frame_of(2, 2);
  FilmFrame after = before;
  after.planes[3].name = "steps";
  const FrameDifference difference = compare_frames(before, after);
  EXPECT_EQ(difference.gone, std::vector<std::string>{"depth"});
  EXPECT_EQ(difference.added, std::vector<std::string>{"steps"});
  EXPECT_FALSE(difference.unchanged());
  EXPECT_THROW((void)compare_frames(before, frame_of(2, 3)), std::invalid_argument);
}

TEST(FrameDifference, ulps_are_counted_across_zero) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(ulps_between(1.0, std::nextafter(1.0, 2.0)), 1U);
  EXPECT_EQ(ulps_between(-least, 2 * least), 3U);
  EXPECT_EQ(ulps_between(0.0, -0.0), 0U);
  EXPECT_EQ(ulps_between(2.0, 1.0), std::uint64_t{1} << 52);
}

}  // namespace
}  // namespace xpr
