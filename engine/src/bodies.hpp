// SPDX-License-Identifier: Apache-2.0
#pragma once

// Where bodies are kept, and their sights, which neighbours look at (sight.hpp).
//
// A sight repeats the high words of a motion, rounded to double. A plain world of doubles keeps
// them once: a body is there a sight and what is exact beside it, a line of memory each, apart from
// each other, because most looks are for the sight alone. Other worlds keep whole bodies, and
// sights beside them, which may show a motion from another frame.

#include "body.hpp"
#include "laws.hpp"
#include "prefetch.hpp"
#include "sight.hpp"

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace stoss::engine {

/// Of each body a sight, and what is kept beside it.
template <class Kept, class AnySight>
class BesideSights {
 public:
  using Seen = AnySight;

  std::size_t size() const { return kept_.size(); }
  void reserve(std::size_t count) {
    kept_.reserve(count);
    sights_.reserve(count);
  }
  void add() {
    kept_.emplace_back();
    sights_.emplace_back();
  }
  AnySight& sight(Slot slot) { return sights_[static_cast<std::size_t>(slot)]; }
  const AnySight& sight(Slot slot) const { return sights_[static_cast<std::size_t>(slot)]; }
  const std::vector<AnySight>& sights() const { return sights_; }
  void prefetch_sight(Slot slot) const { prefetch(&sight(slot)); }
  /// And all else that is kept of a body.
  void prefetch_body(Slot slot) const {
    prefetch_sight(slot);
    prefetch_all(kept(slot));
  }

 protected:
  Kept& kept(Slot slot) { return kept_[static_cast<std::size_t>(slot)]; }
  const Kept& kept(Slot slot) const { return kept_[static_cast<std::size_t>(slot)]; }

 private:
  std::vector<Kept> kept_;
  std::vector<AnySight> sights_;
};

template <class S, class Laws>
class Bodies : public BesideSights<Body<S, Laws>, Sight> {
 public:
  using View = Body<S, Laws>&;
  using ConstView = const Body<S, Laws>&;

  View at(Slot slot) { return this->kept(slot); }
  ConstView at(Slot slot) const { return this->kept(slot); }
  /// Back to a body that nobody has; `changes` stays.
  void clear(Slot slot) {
    const std::uint32_t changes = at(slot).changes;
    at(slot) = Body<S, Laws>{};
    at(slot).changes = changes;
  }
};

/// What a body is beside its sight.
struct alignas(64) ExactPart {
  Id id = kNoId;    ///< kNoId: the slot is free
  double mass = 0;  ///< kg, of a disk
  Instant since;
  double x_low = 0;  ///< m
  double y_low = 0;
  double vx_low = 0;  ///< m/s
  double vy_low = 0;
};
static_assert(sizeof(ExactPart) == 64);

/// A body of a plain world of doubles, put together from its two lines; as Body.
template <bool kConst>
class PlainBody {
  template <class T>
  using Ref = std::conditional_t<kConst, const T&, T&>;
  Ref<PlainSight> sight_;
  Ref<ExactPart> exact_;
  /// A wall has no size, and a sight a place for one: whoever looks at it looks at its shape, too.
  static constexpr double kFirstWall = -1;

 public:
  PlainBody(Ref<PlainSight> sight, Ref<ExactPart> exact)
      : sight_(sight), exact_(exact), id(exact.id), changes(sight.changes), type(sight.type) {}

  Ref<Id> id;
  Ref<std::uint32_t> changes;
  Ref<BodyType> type;

  [[gnu::always_inline]] Motion<double> motion() const { return {position(), velocity(), since()}; }
  const Instant& since() const { return exact_.since; }
  [[gnu::always_inline]] DoubleWord2<double> position() const {
    return {{sight_.x, exact_.x_low}, {sight_.y, exact_.y_low}};
  }
  [[gnu::always_inline]] DoubleWord2<double> velocity() const {
    return {{sight_.vx, exact_.vx_low}, {sight_.vy, exact_.vy_low}};
  }
  double radius() const { return is_wall() ? 0 : std::abs(sight_.size); }
  double mass() const { return exact_.mass; }
  std::int32_t wall() const { return static_cast<std::int32_t>(kFirstWall - sight_.size); }

  void set_since(const Instant& instant) { exact_.since = instant; }
  void set_position(const DoubleWord2<double>& position) {
    sight_.x = position.x.hi;
    sight_.y = position.y.hi;
    exact_.x_low = position.x.lo;
    exact_.y_low = position.y.lo;
  }
  void set_velocity(const DoubleWord2<double>& velocity) {
    sight_.vx = velocity.x.hi;
    sight_.vy = velocity.y.hi;
    exact_.vx_low = velocity.x.lo;
    exact_.vy_low = velocity.y.lo;
  }
  void set_radius(double radius) { sight_.size = is_dynamic() ? radius : -radius; }
  void set_mass(double mass) { exact_.mass = mass; }
  void set_wall(std::int32_t shape) { sight_.size = kFirstWall - shape; }

  bool is_wall() const { return type == BodyType::Wall; }
  bool is_disk() const { return type <= BodyType::Static; }
  bool is_dynamic() const { return type == BodyType::Dynamic; }
};

template <>
class Bodies<double, PlainLaws> : public BesideSights<ExactPart, PlainSight> {
 public:
  using View = PlainBody<false>;
  using ConstView = PlainBody<true>;

  View at(Slot slot) { return {sight(slot), kept(slot)}; }
  ConstView at(Slot slot) const { return {sight(slot), kept(slot)}; }
  void clear(Slot slot) {
    const std::uint32_t changes = sight(slot).changes;
    kept(slot) = {};
    sight(slot) = {};
    sight(slot).changes = changes;
  }
};

}  // namespace stoss::engine
