// An array of fixed size that starts on a cache line and is not initialised.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

#include "base/assert.hpp"

namespace onset {

template <class T>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size)
      : data_(static_cast<T*>(::operator new(size * sizeof(T) + 1, std::align_val_t(64)))), size_(size) {}
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) {
    ONSET_ASSERT(i < size_);
    return data_.get()[i];
  }
  const T& operator[](std::size_t i) const {
    ONSET_ASSERT(i < size_);
    return data_.get()[i];
  }

 private:
  struct Free {
    void operator()(T* p) const { ::operator delete(p, std::align_val_t(64)); }
  };
  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
};

}  // namespace onset
