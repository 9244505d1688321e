#pragma once

#include <cstddef>
#include <memory>
#include <new>

/// Allocator for the CGAL skeleton code: addresses increase in the order of allocation.
namespace stackabilization::detail {

/// One block of memory. It is handed out from its low end to its high end and freed as a whole.
class CreationOrderMemory {
 public:
  /// Becomes the memory of CreationOrderAllocator in this thread until its destruction. `bytes`: size of the
  /// block.
  explicit CreationOrderMemory(std::size_t bytes)
      : block_(new std::byte[bytes]), room_(bytes), next_(block_.get()), outer_(current_) {
    current_ = this;
  }
  CreationOrderMemory(const CreationOrderMemory&) = delete;
  CreationOrderMemory& operator=(const CreationOrderMemory&) = delete;
  ~CreationOrderMemory() { current_ = outer_; }

  /// Returns the next `bytes` bytes of the block of this thread. Throws std::bad_alloc when the block is used
  /// up or the thread has none.
  static void* take(std::size_t bytes, std::size_t alignment) {
    if (current_ == nullptr || std::align(alignment, bytes, current_->next_, current_->room_) == nullptr)
      throw std::bad_alloc();
    void* const taken = current_->next_;
    current_->next_ = static_cast<std::byte*>(taken) + bytes;
    current_->room_ -= bytes;
    return taken;
  }

 private:
  std::unique_ptr<std::byte[]> block_;
  std::size_t room_;
  void* next_;
  CreationOrderMemory* outer_;
  static inline thread_local CreationOrderMemory* current_ = nullptr;
};

/// Allocator of the CreationOrderMemory of the thread. A later allocation has a higher address. Algorithms
/// that visit elements by address therefore visit them in the order of creation, and give the same result in
/// every run.
template <class T>
struct CreationOrderAllocator {
  using value_type = T;

  CreationOrderAllocator() = default;
  template <class U>
  CreationOrderAllocator(const CreationOrderAllocator<U>&) {}  // implicit, as allocators convert

  T* allocate(std::size_t count) {
    return static_cast<T*>(CreationOrderMemory::take(count * sizeof(T), alignof(T)));
  }
  void deallocate(T*, std::size_t) {}

  bool operator==(const CreationOrderAllocator&) const { return true; }
};

}  // namespace stackabilization::detail
