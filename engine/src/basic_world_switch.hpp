// SPDX-License-Identifier: Apache-2.0
#pragma once

// Switching effects on a live world. The world is made anew in the kind that the new effects need,
// from bytes that are written as that kind writes them: bodies, ids and counters come over bit for
// bit. For a body whose law of motion becomes another the switch is a physical event, like a
// command: its motion is based at that instant, and if it rests it is let go. No other body's
// motion is touched.

#include "basic_world.hpp"

namespace stoss::engine {

namespace detail {

inline Vector2 gravity_of(const Effects& effects) {
  return effects.gravity ? effects.gravity->acceleration : Vector2::Zero();
}

inline double deceleration_of(const Effects& effects) {
  return effects.floor_friction ? effects.floor_friction->deceleration : 0;
}

inline double drag_of(const Effects& effects) { return effects.drag ? effects.drag->rate : 0; }

inline double growth_of(const Effects& effects) {
  return effects.growth ? effects.growth->rate : 0;
}

}  // namespace detail

/// Would the body move on by another law?
template <class S, class Laws>
bool BasicWorld<S, Laws>::law_differs(Slot slot, const Effects& wanted) const {
  const Effects present = effects();
  if (detail::growth_of(present) != detail::growth_of(wanted)) return at(slot).is_disk();
  if (!at(slot).is_dynamic()) return false;
  if (detail::drag_of(present) != detail::drag_of(wanted)) return true;
  if (detail::gravity_of(present) != detail::gravity_of(wanted)) return true;
  if (detail::deceleration_of(present) == detail::deceleration_of(wanted)) return false;
  const DoubleWord2<S> v = velocity_of(slot, now_);
  return v.x.hi != S(0) || v.y.hi != S(0);
}

template <class S, class Laws>
Outcome<std::unique_ptr<WorldCore>> BasicWorld<S, Laws>::with_effects(const Effects& wanted) const {
  BasicWorld stage = *this;
  stage.crowd_ = 0;
  for (const Slot slot : ordered_slots()) {
    if (!law_differs(slot, wanted)) continue;
    stage.rebase(slot, now_);
    stage.let_go(slot);
  }
  std::unique_ptr<WorldCore> switched =
      make_core_in<S>({to_instant(now_), arithmetic_, broad_phase_, wanted, period()});
  if (const auto read = switched->restore(stage.bytes_for(wanted)); !read) {
    return Reject{.code = Code::FailedPrecondition,
                  .field = "effects",
                  .reason = "cannot be switched at this very instant: " + read.reject().reason};
  }
  switched->take_changes_of(stage);
  return switched;
}

/// Kicks under another thermostat. A wait goes on at the new rate: what is left of it is stretched,
/// for it has no memory.
template <class S, class Laws>
auto BasicWorld<S, Laws>::kicks_under(Slot slot, const Thermostat& wanted) const -> Kicks {
  if constexpr (!Laws::kPlain) {
    if (const auto& present = laws_.as_asked.thermostat) {
      Kicks kicks = kicks_[index(slot)];
      if (present->rate == wanted.rate) return kicks;
      if (kicks.next == Time<S>::never() || !(wanted.rate > 0)) {
        ++kicks.count;  // what was drawn for the next one is used up
        kicks.next = next_kick(slot, wanted, kicks.count, now_);
        return kicks;
      }
      const DoubleWord<S> left =
          difference<S>(kicks.next, now_) * detail::stored<S>(present->rate / wanted.rate);
      kicks.next = later_by(now_, left.hi, left.lo).value_or(Time<S>::never());
      return kicks;
    }
  }
  return first_kick(slot, wanted);
}

}  // namespace stoss::engine
