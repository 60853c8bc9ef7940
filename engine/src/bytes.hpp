// SPDX-License-Identifier: Apache-2.0
#pragma once

// Canonical bytes: little-endian words of 64 bits, whatever the machine. The same words feed the
// serialised form and the digest, so that the two cannot drift apart.

#include <stoss/engine/double_word.hpp>
#include <stoss/engine/instant.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stoss::engine {

/// Appends words to a buffer.
class ByteSink {
 public:
  void word(std::uint64_t w) {
    for (int i = 0; i < 8; ++i) bytes_.push_back(static_cast<std::byte>(w >> (8 * i)));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Digests words. The mixing function is the finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA
/// 2014); a digest tells states apart, it does not resist an adversary.
class DigestSink {
 public:
  void word(std::uint64_t w) {
    state_ += 0x9e3779b97f4a7c15U;
    state_ = mix(state_ ^ mix(w));
  }
  std::uint64_t digest() const { return state_; }

 private:
  static std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  }
  std::uint64_t state_ = 0x73746f7373U;
};

/// Reads words; once it has run out, it reads zeros and says so.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::uint64_t word() {
    if (bytes_.size() < 8) {
      bytes_ = {};
      ran_out_ = true;
      return 0;
    }
    std::uint64_t w = 0;
    for (int i = 0; i < 8; ++i) {
      w |= static_cast<std::uint64_t>(bytes_[static_cast<std::size_t>(i)]) << (8 * i);
    }
    bytes_ = bytes_.subspan(8);
    return w;
  }
  bool ran_out() const { return ran_out_; }
  std::size_t words_left() const { return bytes_.size() / 8; }
  bool at_end() const { return bytes_.empty() && !ran_out_; }

 private:
  std::span<const std::byte> bytes_;
  bool ran_out_ = false;
};

/// How many doubles hold any value of S exactly, as an unevaluated sum.
template <class S>
inline constexpr int kDoublesPerScalar = kCompensated<S> ? 1 : 3;

template <class Sink, class S>
void write_scalar(Sink& sink, S value) {
  for (int i = 0; i < kDoublesPerScalar<S>; ++i) {
    const auto part = static_cast<double>(value);
    sink.word(std::bit_cast<std::uint64_t>(part));
    value = value - S(part);
  }
}

template <class S>
S read_scalar(ByteSource& source) {
  S value = S(std::bit_cast<double>(source.word()));
  for (int i = 1; i < kDoublesPerScalar<S>; ++i) {
    value = value + S(std::bit_cast<double>(source.word()));
  }
  return value;
}

template <class Sink, class S>
void write_scalar(Sink& sink, const DoubleWord<S>& value) {
  write_scalar(sink, value.hi);
  if constexpr (kCompensated<S>) write_scalar(sink, value.lo);
}

template <class S>
DoubleWord<S> read_double_word(ByteSource& source) {
  const S hi = read_scalar<S>(source);
  if constexpr (kCompensated<S>) {
    return {hi, read_scalar<S>(source)};
  } else {
    return {hi, S(0)};
  }
}

template <class Sink, class S>
void write_vector(Sink& sink, const DoubleWord2<S>& v) {
  write_scalar(sink, v.x);
  write_scalar(sink, v.y);
}

template <class S>
DoubleWord2<S> read_vector(ByteSource& source) {
  const DoubleWord<S> x = read_double_word<S>(source);
  return {x, read_double_word<S>(source)};
}

template <class Sink>
void write_time(Sink& sink, const Instant& t) {
  sink.word(static_cast<std::uint64_t>(t.seconds));
  sink.word(t.fraction);
}

template <class Sink>
void write_time(Sink& sink, const WideInstant& t) {
  write_time(sink, t.coarse);
  sink.word(t.fine);
}

template <class T>
T read_time(ByteSource& source) {
  Instant coarse;
  coarse.seconds = static_cast<std::int64_t>(source.word());
  coarse.fraction = source.word();
  if constexpr (std::is_same_v<T, Instant>) {
    return coarse;
  } else {
    return {coarse, source.word()};
  }
}

}  // namespace stoss::engine
