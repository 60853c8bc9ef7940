// SPDX-License-Identifier: Apache-2.0
#include "accuracy/story.hpp"

namespace stoss::client::accuracy {
namespace {

/// Meetings kept: 40 bytes each, so at most 160 MB a story.
constexpr std::size_t kMeetingsMax = 4'000'000;

enum class Verdict : std::uint8_t { Right, Wrong, Untold };

/// Whom each body meets, in its own order, with the page that is read next.
class Diaries {
 public:
  explicit Diaries(const std::vector<Meeting>& meetings) {
    for (const Meeting& meeting : meetings) {
      pages_[meeting.a].partners.push_back(meeting.b);
      pages_[meeting.b].partners.push_back(meeting.a);
    }
  }
  Verdict next(engine::Id body, engine::Id partner) {
    Pages& pages = pages_[body];
    const std::size_t page = pages.read++;
    if (page >= pages.partners.size()) return Verdict::Untold;
    return pages.partners[page] == partner ? Verdict::Right : Verdict::Wrong;
  }

 private:
  struct Pages {
    std::vector<engine::Id> partners;
    std::size_t read = 0;
  };
  std::unordered_map<engine::Id, Pages> pages_;
};

}  // namespace

void Story::on_collision(const engine::Collision& collision) {
  const bool of_disks = collision.kind == engine::ContactKind::DiskDisk;
  ++count_;
  if (of_disks) ++pairs_;
  if (meetings_.size() < kMeetingsMax) {
    meetings_.push_back({collision.a, collision.b, collision.instant, of_disks});
  }
}

Agreement compare(const Story& reference, const Story& story, const engine::Instant& open_from) {
  Diaries diaries(story.meetings());
  Agreement agreement;
  for (const Meeting& meeting : reference.meetings()) {
    const Verdict a = diaries.next(meeting.a, meeting.b);
    const Verdict b = diaries.next(meeting.b, meeting.a);
    if (a != Verdict::Right || b != Verdict::Right) {
      const bool wrong = a == Verdict::Wrong || b == Verdict::Wrong;
      const bool may_be_the_end = meeting.instant > open_from || !story.complete();
      if (!wrong && may_be_the_end) continue;
      agreement.first_wrong = meeting.instant;
      break;
    }
    ++agreement.collisions;
    if (meeting.of_disks) ++agreement.pairs;
  }
  return agreement;
}

}  // namespace stoss::client::accuracy
