// SPDX-License-Identifier: Apache-2.0
#pragma once

// When a disk can meet a wall at the earliest, by their sights (sight.hpp).
//
// The centre must come to the line's side or to an end. With e the wall's edge (m), p, v the
// disk's position (m) and velocity (m/s) relative to its start, r the radius (m):
//
//   (1) h = e x p,  w = e x v:  the line's side after (|h| - |e| r) / (-sign(h) w)
//   (2) s = e.p + t e.v:        beside the wall, not beyond its ends, where 0 <= s <= e.e
//   (3) an end as a disk without radius: (2) in sight.hpp
//
// The centre comes to an end only from within the strip of (1): so where (2) holds when it enters
// the strip that is the contact, and else it is one with an end.
//
// Source: as in contact_time/disk_wall.hpp.
// Deviation: every quantity is widened by its error, so that the time is a lower bound and "never"
// is certain. Where errors leave it open whether the disk is beside the wall it counts as beside
// it, and where they leave open whether it has entered the strip it meets at once.
// Accuracy: as that of sights: tests/engine/wall_sight_test.cpp.

#include "sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stoss::engine {

/// A disk as it is seen from the start of a wall.
class WallView {
 public:
  /// At the present; `edge_x`, `edge_y`: m, rounded; `slack`: kScreenSlack of the arithmetic.
  WallView(const Present& disk, const Present& wall, double edge_x, double edge_y, double slack)
      : disk_(disk), start_(wall), ex_(edge_x), ey_(edge_y), slack_(slack) {
    const double px = disk.x - wall.x, py = disk.y - wall.y;
    const double vx = disk.vx - wall.vx, vy = disk.vy - wall.vy;
    length2_ = ex_ * ex_ + ey_ * ey_;
    const double length = std::sqrt(length2_);
    const double h = ex_ * py - ey_ * px;
    const double w = ex_ * vy - ey_ * vx;
    distance_ = std::abs(h);
    closing_ = h > 0 ? -w : w;
    closing_off_ = slack * length * (std::abs(vx) + std::abs(vy));
    along_ = ex_ * px + ey_ * py;
    along_rate_ = ex_ * vx + ey_ * vy;
    reach_ = length * disk.radius;
    const double rounding_of_edge = kSightRounding * (std::abs(ex_) + std::abs(ey_));
    off_ = length * (disk.off + wall.off + rounding_of_edge +
                     slack * (std::abs(px) + std::abs(py) + disk.radius));
  }

  /// Seconds before which the two certainly do not meet; infinity if they never do.
  double soonest_contact() const {
    constexpr double kLeast = 1e-290;  // below, it is no length any more, nor seen from a disk
    if (!(off_ < kNever)) return 0;    // they may be anywhere
    if (!(length2_ > kLeast)) return soonest_at_ends();
    return closing_ <= -closing_off_ ? soonest_of_receding() : soonest_of_approaching();
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  double soonest_of_approaching() const {
    const double to_go = distance_ - reach_ - off_;
    if (to_go > 0) {
      const double enters = to_go / ((closing_ + closing_off_) * (1 + slack_));
      return may_be_beside(enters, latest_entry()) ? enters : soonest_at_ends();
    }
    const bool is_within = distance_ < reach_ - off_;
    return may_be_beside(0, is_within ? 0 : kNever) ? 0 : soonest_at_ends();
  }
  double soonest_of_receding() const {
    if (distance_ > reach_ + off_) return kNever;
    const bool is_beside = along_ > off_ && along_ < length2_ - off_;
    const bool is_outside = distance_ > reach_ - 2 * off_;  // for those beside do not overlap
    return is_beside && is_outside ? kNever : soonest_at_ends();
  }
  double latest_entry() const {
    const double rate = (closing_ - closing_off_) * (1 - slack_);
    return rate > 0 ? (distance_ - reach_ + off_) / rate : kNever;
  }
  // At some time between the two, s from now?
  bool may_be_beside(double from, double until) const {
    const double least_rate = along_rate_ - closing_off_, most_rate = along_rate_ + closing_off_;
    const double least = along_ - off_ + std::min(least_rate * from, least_rate * until);
    const double most = along_ + off_ + std::max(most_rate * from, most_rate * until);
    return !(most < 0) && !(least > length2_);
  }
  double soonest_at_ends() const {
    return std::min(soonest_at(start_.x, start_.y), soonest_at(start_.x + ex_, start_.y + ey_));
  }
  double soonest_at(double x, double y) const {
    const SightsOf<double> end{x, y, start_.vx, start_.vy, 0, 0, start_.off};
    return engine::soonest_contact<double>(disk_, end, 0, slack_, Steady{});
  }

  Present disk_;
  Present start_;  // of the wall
  double ex_, ey_, slack_;
  double length2_;
  double distance_, closing_, closing_off_;  // (1), times the length
  double along_, along_rate_;                // (2)
  double reach_, off_;                       // times the length
};

}  // namespace stoss::engine
