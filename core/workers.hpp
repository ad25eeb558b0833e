// A few threads that share a loop's blocks: the one place that knows oneTBB's loops.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace xpr {

class Workers {
 public:
  /// `threads` of them, the caller's included; 0: as many as the machine has.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Calls body(first, last) for blocks that make up [begin, end), in any order, several at once; none is split that is
  /// no longer than `grain`. Returns when all are done. What a body throws ends the loop and is thrown here.
  void for_blocks(std::size_t begin, std::size_t end, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace xpr
