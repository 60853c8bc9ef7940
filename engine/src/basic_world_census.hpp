// SPDX-License-Identifier: Apache-2.0
#pragma once

// The census: the whole world checked from its stored motions, by a sweep that shares nothing with
// the broad phase under test.

#include "basic_world.hpp"

#include <algorithm>

namespace stoss::engine {

namespace detail {

inline Aabb moved_by(const Aabb& box, const Vector2& way) {
  return {box.low_x + way.x(), box.low_y + way.y(), box.high_x + way.x(), box.high_y + way.y()};
}

}  // namespace detail

/// The extent of a body's flight from its last event to now(), in doubles.
template <class S, class Laws>
Aabb BasicWorld<S, Laws>::swept_box(Slot slot) const {
  return swept_box(slot, tight_box(slot));
}

/// `end`: the extent at now(), of whichever image.
template <class S, class Laws>
Aabb BasicWorld<S, Laws>::swept_box(Slot slot, const Aabb& end) const {
  const DoubleWord2<S> now = position_of(slot, now_);
  const DoubleWord2<S>& then = at(slot).position();
  const auto back_x = static_cast<double>(to_scalar(then.x - now.x));
  const auto back_y = static_cast<double>(to_scalar(then.y - now.y));
  const Aabb start{
      end.low_x + back_x, end.low_y + back_y, end.high_x + back_x, end.high_y + back_y};
  if constexpr (Laws::kDragged) {
    // It flies within the parallelogram of its two shares, v s and a f.
    if (!at(slot).is_dynamic()) return merged(start, end);
    const double run = detail::rough_drag_clock(rough_seconds(now_, at(slot).since()),
                                                static_cast<double>(laws_.drag))
                           .run;
    const Vector2 share = run * detail::rounded(at(slot).velocity());
    return merged(merged(start, end),
                  merged(detail::moved_by(start, share), detail::moved_by(end, -share)));
  }
  double sag = 0;  // between its ends a parabola leaves the chord by a T^2 / 8
  if constexpr (Laws::kCurved) {
    const double elapsed = rough_seconds(now_, at(slot).since());
    sag = pull_of(slot) * elapsed * elapsed / 8 * (1 + kScreenSlack<S>);
  }
  return grown(merged(start, end), sag);
}

template <class S, class Laws>
void BasicWorld<S, Laws>::examine(Slot a, Slot b, const Which& image, Census& census) const {
  ++census.pairs;
  const double gap = clearance(a, b, image);
  const double reach = reach_of(a, b);
  if (gap < 0) {
    census.deepest = std::max(census.deepest, -gap / reach);
    if (gap < -kOverlapTolerance * reach) ++census.overlaps;
  }
  const bool as_they_stand = at(b).is_wall() || (!at(a).is_wall() && at(a).id < at(b).id);
  const auto contact = as_they_stand ? contact_with(a, b, image) : contact_with(b, a, -image);
  if (!contact) return;
  const auto event = event_of(*contact, b);
  if (event && event->at < now_) ++census.missed;
}

template <class S, class Laws>
Census BasicWorld<S, Laws>::census() const {
  if constexpr (!Laws::kPlain) {
    if (is_periodic()) return census_of_images();
  }
  struct Entry {
    Aabb box;
    Slot slot;
  };
  std::vector<Entry> entries;
  entries.reserve(slots_.size());
  for (const Slot slot : ordered_slots()) entries.push_back({swept_box(slot), slot});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.box.low_x != b.box.low_x ? a.box.low_x < b.box.low_x : a.slot < b.slot;
  });
  Census census;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size(); ++j) {
      if (entries[j].box.low_x > entries[i].box.high_x) break;
      if (!overlaps(entries[i].box, entries[j].box)) continue;
      if (!interacts(entries[i].slot, entries[j].slot)) continue;
      if (is_zone(entries[i].slot) || is_zone(entries[j].slot)) continue;
      examine(entries[i].slot, entries[j].slot, {}, census);
    }
  }
  return census;
}

// The sweep goes around a periodic axis: a box meets the images of those whose low side lies within
// it, and each image of each pair comes up once.
template <class S, class Laws>
Census BasicWorld<S, Laws>::census_of_images() const {
  Census census;
  if constexpr (!Laws::kPlain) {
    struct Entry {
      Aabb box;
      Slot slot;
      Image home;
    };
    std::vector<Entry> entries;
    entries.reserve(slots_.size());
    for (const Slot slot : ordered_slots()) {
      const Aabb box = swept_box(slot);
      const auto home = [](double low, double length) {
        return length > 0 ? -static_cast<std::int64_t>(std::floor(low / length)) : 0;
      };
      const Image image{home(box.low_x, space_.length_x), home(box.low_y, space_.length_y)};
      const Glance there = space_.image_of(glance_of(slot), image);
      entries.push_back({swept_box(slot, tight_box(slot, there)), slot, image});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.box.low_x != b.box.low_x ? a.box.low_x < b.box.low_x : a.slot < b.slot;
    });
    const auto examine_images = [&](const Entry& a, const Entry& b, std::int64_t x) {
      if (!interacts(a.slot, b.slot) || is_zone(a.slot) || is_zone(b.slot)) return;
      const auto in_y = detail::images_that_meet(
          a.box.low_y, a.box.high_y, b.box.low_y, b.box.high_y, space_.length_y);
      for (std::int64_t y = in_y.first; y <= in_y.last; ++y) {
        examine(a.slot, b.slot, Image{x, y} + b.home - a.home, census);
      }
    };
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Entry& a = entries[i];
      std::int64_t x = 0;
      for (std::size_t j = i + 1;; ++j) {
        if (j == entries.size()) {
          if (!(space_.length_x > 0)) break;
          j = 0;
          ++x;
        }
        const double low = entries[j].box.low_x + static_cast<double>(x) * space_.length_x;
        if (low > a.box.high_x) break;
        examine_images(a, entries[j], x);
      }
    }
  }
  return census;
}

}  // namespace stoss::engine
