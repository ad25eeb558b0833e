#include "core/scene/snapshot_bus.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "core/workers.hpp"

namespace xpr {
namespace {

/// A snapshot in which everything says the same number.
std::shared_ptr<const SceneSnapshot> numbered(std::int64_t number) {
  auto scene = std::make_shared<SceneSnapshot>();
  scene->film.seed = number;
  scene->header.name = std::to_string(number);
  scene->fields.sources.resize(static_cast<std::size_t>(number % 7));
  return scene;
}

bool is_whole(const SceneSnapshot& scene) {
  return scene.header.name == std::to_string(scene.film.seed) &&
         scene.fields.sources.size() == static_cast<std::size_t>(scene.film.seed % 7);
}

TEST(SnapshotBus, holds_nothing_before_the_first_is_published) {
  const SnapshotBus bus;
  EXPECT_EQ(bus.latest().version, 0U);
  EXPECT_EQ(bus.latest().scene, nullptr);
}

TEST(SnapshotBus, a_frame_keeps_the_snapshot_that_it_took) {
  SnapshotBus bus;
  EXPECT_EQ(bus.publish(numbered(1)), 1U);
  const PublishedSnapshot frame = bus.latest();
  EXPECT_EQ(bus.publish(numbered(2)), 2U);
  EXPECT_EQ(frame.scene->film.seed, 1);
  EXPECT_EQ(bus.latest().scene->film.seed, 2);
}

TEST(SnapshotBus, hands_out_whole_snapshots_while_others_are_published) {
  SnapshotBus bus;
  bus.publish(numbered(0));
  std::atomic<int> torn{0}, backwards{0};
  Workers(4).for_blocks(0, 2000, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const PublishedSnapshot before = bus.latest();
      const std::uint64_t mine = i % 2 == 0 ? bus.publish(numbered(static_cast<std::int64_t>(i))) : before.version;
      const PublishedSnapshot after = bus.latest();
      if (!is_whole(*before.scene) || !is_whole(*after.scene)) ++torn;
      if (after.version < mine || mine < before.version) ++backwards;
    }
  });
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
  EXPECT_EQ(bus.latest().version, 1001U);
}

}  // namespace
}  // namespace xpr
