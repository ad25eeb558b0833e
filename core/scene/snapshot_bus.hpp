// Whole snapshots handed from whoever makes scenes to whoever renders frames, between frames.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>

#include "core/scene/snapshot.hpp"

namespace xpr {

/// A snapshot and how many were published up to it; 0 and none before the first.
struct PublishedSnapshot {
  std::shared_ptr<const SceneSnapshot> scene;
  std::uint64_t version = 0;
};

/// Any number of threads may publish and take. A frame that has taken a snapshot keeps it unchanged, whatever is
/// published meanwhile.
class SnapshotBus {
 public:
  /// Returns its version, one more than the last.
  std::uint64_t publish(std::shared_ptr<const SceneSnapshot> scene) {
    const std::lock_guard lock(mutex_);
    latest_ = {std::move(scene), latest_.version + 1};
    return latest_.version;
  }
  [[nodiscard]] PublishedSnapshot latest() const {
    const std::lock_guard lock(mutex_);
    return latest_;
  }

 private:
  mutable std::mutex mutex_;
  PublishedSnapshot latest_;
};

}  // namespace xpr
