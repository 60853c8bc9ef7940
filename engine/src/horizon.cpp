// SPDX-License-Identifier: Apache-2.0
#include <stoss/engine/horizon.hpp>

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace stoss::engine {

namespace {

struct Meeting {
  Id a = kNoId;
  Id b = kNoId;
  Instant instant;
  bool of_disks = false;
};

class MeetingLog final : public CollisionSink {
 public:
  void on_collision(const Collision& c) override {
    meetings_.push_back({c.a, c.b, c.instant, c.kind == ContactKind::DiskDisk});
  }
  const std::vector<Meeting>& meetings() const { return meetings_; }

 private:
  std::vector<Meeting> meetings_;
};

/// Whom each body meets, in its own order: unrelated collisions may change places in the log
/// without the runs being different.
using Diary = std::unordered_map<Id, std::vector<Id>>;

Diary diary_of(const std::vector<Meeting>& meetings) {
  Diary diary;
  for (const Meeting& m : meetings) {
    diary[m.a].push_back(m.b);
    diary[m.b].push_back(m.a);
  }
  return diary;
}

/// Index of the first meeting that the other run's diaries do not have.
std::size_t first_difference(const std::vector<Meeting>& meetings, const Diary& other) {
  std::unordered_map<Id, std::size_t> met;
  const auto agrees = [&](Id body, Id partner) {
    const std::size_t n = met[body]++;
    const auto pages = other.find(body);
    return pages != other.end() && n < pages->second.size() && pages->second[n] == partner;
  };
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    const bool a = agrees(meetings[i].a, meetings[i].b);
    const bool b = agrees(meetings[i].b, meetings[i].a);
    if (!a || !b) return i;
  }
  return meetings.size();
}

/// Advances until the log holds `count` collisions or the instant is reached.
Outcome<Stop> run(World& world, const Instant& until, std::uint64_t count, MeetingLog& log) {
  constexpr std::uint64_t kStride = 4096;
  while (log.meetings().size() < count) {
    const auto report = world.advance_to(until, &log, kStride);
    if (!report) return report.reject();
    if (report.value().stop != Stop::EventBudget) return report.value().stop;
  }
  return Stop::EventBudget;
}

double per_disk(const World& world, const std::vector<Meeting>& meetings, std::size_t agreed) {
  const auto pairs = std::count_if(meetings.begin(),
                                   meetings.begin() + static_cast<std::ptrdiff_t>(agreed),
                                   [](const Meeting& m) { return m.of_disks; });
  std::size_t disks = 0;
  world.for_each_disk([&](const BodyState& s) { disks += s.kind == BodyKind::Dynamic ? 1U : 0U; });
  return disks == 0 ? 0 : 2 * static_cast<double>(pairs) / static_cast<double>(disks);
}

}  // namespace

Outcome<Horizon> measure_horizon(const World& world,
                                 const Instant& until,
                                 std::uint64_t max_collisions,
                                 std::uint64_t seed) {
  World exact = world;
  World twin = world;
  twin.nudge(seed);
  // Doubling, so that a short horizon costs little however far was asked.
  MeetingLog log;
  MeetingLog twin_log;
  for (std::uint64_t count = std::min<std::uint64_t>(1024, max_collisions);;
       count = std::min(2 * count, max_collisions)) {
    const auto stop = run(exact, until, count, log);
    if (!stop) return stop.reject();
    // The twin runs a little further, so that the end of its log is no difference.
    const auto twin_stop = run(twin, until, log.meetings().size() + world.disk_count(), twin_log);
    if (!twin_stop) return twin_stop.reject();
    const auto& meetings = log.meetings();
    const std::size_t agreed = first_difference(meetings, diary_of(twin_log.meetings()));
    const bool ended = stop.value() != Stop::EventBudget || count >= max_collisions;
    if (agreed == meetings.size() && !ended) continue;
    Horizon horizon;
    horizon.reached_end = agreed == meetings.size();
    horizon.instant = horizon.reached_end ? exact.now() : meetings[agreed].instant;
    horizon.collisions = agreed;
    horizon.collisions_per_disk = per_disk(world, meetings, agreed);
    return horizon;
  }
}

}  // namespace stoss::engine
