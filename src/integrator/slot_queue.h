#pragma once

#include <cstdint>
#include <vector>

namespace photopic {

/// Slots of a batch that wait for the same thing. There is room for all of them from the start.
class SlotQueue {
 public:
  explicit SlotQueue(std::size_t capacity) : slots_(capacity) {}

  void push(std::uint32_t slot) { slots_[size_++] = slot; }
  /// All slots up to a number.
  void fill(std::uint32_t count) {
    clear();
    for (std::uint32_t slot = 0; slot < count; ++slot) push(slot);
  }
  void clear() { size_ = 0; }

  /// Drops the slots that do not `stay`. Which those are cannot be foretold, so there is no branch for each.
  template <typename Stays>
  void keep_if(const Stays& stays) {
    std::size_t kept = 0;
    for (const std::uint32_t slot : *this) {
      slots_[kept] = slot;
      kept += stays(slot) ? 1 : 0;
    }
    size_ = kept;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::uint32_t operator[](std::size_t i) const { return slots_[i]; }
  const std::uint32_t* begin() const { return slots_.data(); }
  const std::uint32_t* end() const { return slots_.data() + size_; }

 private:
  std::vector<std::uint32_t> slots_;
  std::size_t size_ = 0;
};

}  // namespace photopic
