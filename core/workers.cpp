#include "core/workers.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#if defined(XPR_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#endif

namespace xpr {
namespace {

/// A point that one thread passes before another, told to the thread sanitizer: oneTBB is not built with it, so that
/// it sees neither where a loop forks nor where it joins. This file is not either, as oneTBB's templates are compiled
/// here. Races between blocks stay visible.
class Order {
 public:
#if defined(XPR_THREAD_SANITIZER)
  void before() { __tsan_release(&point_); }
  void after() { __tsan_acquire(&point_); }

 private:
  char point_ = 0;
#else
  void before() {}
  void after() {}
#endif
};

/// Marks the end of a block, thrown out of or not.
class Block {
 public:
  Block(Order& fork, Order& join) : join_(join) { fork.after(); }
  ~Block() { join_.before(); }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

 private:
  Order& join_;
};

}  // namespace

struct Workers::Arena {
  tbb::task_arena arena;
};

Workers::Workers(int threads)
    : arena_(new Arena{tbb::task_arena(threads > 0 ? threads : tbb::task_arena::automatic)}) {}

Workers::~Workers() = default;

void Workers::for_blocks(std::size_t begin, std::size_t end, std::size_t grain,
                         const std::function<void(std::size_t, std::size_t)>& body) {
  Order fork, join;
  fork.before();
  arena_->arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain), [&](const auto& range) {
      const Block block(fork, join);
      body(range.begin(), range.end());
    });
  });
  join.after();
}

}  // namespace xpr
