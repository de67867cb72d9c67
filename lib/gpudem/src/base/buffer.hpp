// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The only owner of device memory: move-only, trivially copyable elements, a name for messages.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace gpudem {

/// Array in the memory of backend Exec. Contents are undefined after growth.
template <class Exec, class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>, "device memory holds plain data only");

 public:
  explicit Buffer(const char *name) : name_(name) {}
  Buffer(Buffer &&o) noexcept
      : data_(std::exchange(o.data_, nullptr)), capacity_(std::exchange(o.capacity_, 0)), name_(o.name_)
  {
  }
  Buffer &operator=(Buffer &&) = delete;
  Buffer(const Buffer &) = delete;
  Buffer &operator=(const Buffer &) = delete;
  ~Buffer() { Exec::release(data_); }

  /// Make room for \p count elements; keeps the memory when it suffices.
  void reserve(std::size_t count)
  {
    if (count <= capacity_) return;
    clear();
    data_ = static_cast<T *>(Exec::allocate(count * sizeof(T), name_));
    capacity_ = count;
  }
  /// reserve() with some room for growth, for sizes that vary from rebuild to rebuild.
  void reserveWithSlack(std::size_t count)
  {
    if (count > capacity_) reserve(count + count / 16);
  }
  void clear() noexcept
  {
    Exec::release(data_);
    data_ = nullptr;
    capacity_ = 0;
  }
  void swap(Buffer &o) noexcept
  {
    std::swap(data_, o.data_);
    std::swap(capacity_, o.capacity_);
  }
  T *data() { return data_; }
  const T *data() const { return data_; }
  std::size_t capacity() const { return capacity_; }
  std::size_t bytes() const { return capacity_ * sizeof(T); }
  const char *name() const { return name_; }

 private:
  T *data_ = nullptr;
  std::size_t capacity_ = 0;
  const char *name_;
};

}  // namespace gpudem
