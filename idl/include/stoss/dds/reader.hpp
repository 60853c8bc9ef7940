// SPDX-License-Identifier: Apache-2.0
// Taking samples. One thread per reader; a Samples must go before the next take of its reader.
#pragma once

#include <stoss/dds/topic.hpp>

#include <array>
#include <cstddef>
#include <utility>

namespace stoss::dds {

/// One received sample, lent by the reader.
template <class T>
struct Sample {
  const T& data;
  const dds_sample_info_t& info;

  /// False when this only tells of an instance's state: then only the key members of `data` are
  /// set.
  [[nodiscard]] bool valid() const noexcept { return info.valid_data; }
  /// True when the instance was disposed of.
  [[nodiscard]] bool disposed() const noexcept {
    return info.instance_state == DDS_IST_NOT_ALIVE_DISPOSED;
  }
  /// True when no writer of the instance is left.
  [[nodiscard]] bool orphaned() const noexcept {
    return info.instance_state == DDS_IST_NOT_ALIVE_NO_WRITERS;
  }
};

/// The most samples that one take yields. Cyclone makes room for all of them at once.
inline constexpr std::size_t kTakeBatch = 16;

/// Where a drain stops for others to have their turn; a WaitSet still reports what is left.
inline constexpr std::size_t kDrainMost = 4096;

/// A batch of samples on loan; gives it back when it goes.
template <class T>
class Samples {
 public:
  class Iterator {
   public:
    Iterator(const Samples* samples, std::size_t index) : samples_(samples), index_(index) {}
    Sample<T> operator*() const noexcept { return (*samples_)[index_]; }
    Iterator& operator++() noexcept {
      ++index_;
      return *this;
    }
    friend bool operator==(const Iterator&, const Iterator&) = default;

   private:
    const Samples* samples_;
    std::size_t index_;
  };

  Samples(dds_entity_t reader, std::size_t most) noexcept : reader_(reader) {
    most = most < kTakeBatch ? most : kTakeBatch;
    if (most == 0) return;
    count_ = dds_take(reader_, data_.data(), info_.data(), most, static_cast<std::uint32_t>(most));
  }
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;
  ~Samples() {
    if (count_ > 0) static_cast<void>(dds_return_loan(reader_, data_.data(), count_));
  }

  [[nodiscard]] std::size_t size() const noexcept {
    return count_ > 0 ? static_cast<std::size_t>(count_) : 0;
  }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  /// False when the take itself failed; then there are no samples.
  [[nodiscard]] bool ok() const noexcept { return count_ >= 0; }
  [[nodiscard]] Sample<T> operator[](std::size_t i) const noexcept {
    return {*static_cast<const T*>(data_[i]), info_[i]};
  }
  [[nodiscard]] Iterator begin() const noexcept { return {this, 0}; }
  [[nodiscard]] Iterator end() const noexcept { return {this, size()}; }

 private:
  dds_entity_t reader_;
  std::array<void*, kTakeBatch> data_{};
  std::array<dds_sample_info_t, kTakeBatch> info_;
  dds_return_t count_ = 0;
};

/// Reads samples of type T.
template <class T>
class Reader : public Entity {
 public:
  /// Throws Error.
  Reader(const Subscriber& subscriber, const Topic<T>& topic, const Qos& qos)
      : Entity(dds_create_reader(subscriber.handle(), topic.handle(), qos.raw(), nullptr),
               "create reader") {}

  /// Takes at most `most` samples (and at most kTakeBatch) out of the reader; does not wait.
  [[nodiscard]] Samples<T> take(std::size_t most = kTakeBatch) noexcept {
    return Samples<T>(handle(), most);
  }

  /// Calls `each(Sample<T>)` for what has arrived, batch by batch, until nothing is left or some
  /// `most` samples were taken: a flood must not hold its reader's thread for ever. Returns how
  /// many.
  template <class F>
  std::size_t drain(F&& each, std::size_t most = kDrainMost) {
    std::size_t total = 0;
    while (total < most) {
      const Samples<T> samples = take();
      for (const Sample<T> sample : samples) each(sample);
      total += samples.size();
      if (samples.size() < kTakeBatch) break;
    }
    return total;
  }

  /// How many writers are matched now.
  [[nodiscard]] int writers() const noexcept {
    const dds_return_t count = dds_get_matched_publications(handle(), nullptr, 0);
    return count > 0 ? count : 0;
  }
};

}  // namespace stoss::dds
