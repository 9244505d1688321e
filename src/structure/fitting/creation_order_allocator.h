#pragma once

#include <cstddef>
#include <memory>
#include <new>

/// For one source file, which hands it to CGAL.
namespace stackabilization::detail {

/// One block of memory that is given out from its low end to its high end and taken back as a whole.
class CreationOrderMemory {
 public:
  /// Becomes the memory of CreationOrderAllocator in this thread, until it is destroyed.
  explicit CreationOrderMemory(std::size_t bytes)
      : block_(new std::byte[bytes]), room_(bytes), next_(block_.get()), outer_(current_) {
    current_ = this;
  }
  CreationOrderMemory(const CreationOrderMemory&) = delete;
  CreationOrderMemory& operator=(const CreationOrderMemory&) = delete;
  ~CreationOrderMemory() { current_ = outer_; }

  /// Throws std::bad_alloc when the block is used up, or this thread has none.
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

/// What is allocated later lies higher. Algorithms that visit elements in the order of their addresses so
/// visit them in the order of their creation, and give the same result in every run.
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
