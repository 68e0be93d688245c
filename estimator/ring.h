#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::estimator {

/// A queue of bounded size with random access, on storage that is allocated once. A place is a
/// number that counts entries since the beginning of time, and wraps nowhere.
template <class T>
class Ring {
 public:
  using Place = std::uint64_t;

  /// `blank` fills the storage.
  Ring(std::size_t capacity, const T& blank) : storage_(capacity, blank) {}

  Place begin() const { return begin_; }
  Place end() const { return end_; }
  bool empty() const { return begin_ == end_; }
  bool full() const { return end_ - begin_ == storage_.size(); }
  std::size_t size() const { return end_ - begin_; }

  T& operator[](Place place) { return storage_[place % storage_.size()]; }
  const T& operator[](Place place) const { return storage_[place % storage_.size()]; }
  const T& front() const { return (*this)[begin_]; }
  const T& back() const { return (*this)[end_ - 1]; }

  /// There must be room.
  void PushBack(const T& value) { assert(!full()), (*this)[end_++] = value; }
  void PopFront() { ++begin_; }
  void PopBack() { --end_; }
  void Clear() { begin_ = end_; }

  /// Puts `value` at `place`; what was there and behind it moves back by one. There must be room.
  void Insert(Place place, const T& value) {
    assert(!full() && begin_ <= place && place <= end_);
    for (Place later = end_++; later > place; --later) (*this)[later] = (*this)[later - 1];
    (*this)[place] = value;
  }

 private:
  std::vector<T> storage_;
  Place begin_ = 0, end_ = 0;
};

}  // namespace reckon::estimator
