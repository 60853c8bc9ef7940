// SPDX-License-Identifier: Apache-2.0
// The publisher's thread: the only one that writes to DDS. It takes what the others hand over, in
// that order, keeps its own picture of the world, and never makes anybody wait.
#pragma once

#include "collision_port.hpp"
#include "frame_port.hpp"
#include "frame_times.hpp"
#include "inbox.hpp"
#include "mailboxes.hpp"
#include "motion_port.hpp"
#include "outbox.hpp"
#include "picture.hpp"
#include "scene_port.hpp"
#include "topics.hpp"
#include "transfers.hpp"
#include "zone_port.hpp"

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace stoss::service {

struct PublicationOptions {
  std::string world;
  std::string scene_name;
  double frame_rate = 20;  ///< frames per real second, > 0
  engine::Arithmetic arithmetic = engine::Arithmetic::Double;
  engine::Vector2 period = engine::Vector2::Zero();  ///< m; 0: open
};

/// What other threads know and the status tells.
struct SharedCounters {
  std::atomic<std::uint64_t> queue_full{0};  ///< requests refused because a queue was full
  std::atomic<std::uint64_t> malformed{0};   ///< requests refused before they reached the world
};

class Publication {
 public:
  Publication(const dds::Participant& participant,
              const Topics& topics,
              const PublicationOptions& options,
              const Clock& clock,
              Inbox& inbox,
              Outbox& outbox,
              const SharedCounters& shared);

  /// Handles what waits, and what is due; waits for it at most as long as nothing is due.
  void turn();
  /// Sends everything that waits, and gives readers a moment to acknowledge it.
  void finish();

 private:
  void handle(TickRecord& record);
  void handle(EpochRecord& record);
  void handle(ReplyItem& item);
  void handle(AnswerItem& item);
  void handle(PictureQuery& query);
  void handle(const WatchRecord& record);
  void handle(const WorldStatus& status);

  void handle_all(std::deque<OutboxItem> items);
  void answer_from_picture();
  void start(PictureQuery& query);
  [[nodiscard]] std::shared_ptr<AnswerContent> content_for(const translate::QuerySpec& query);
  [[nodiscard]] std::shared_ptr<AnswerContent> shared_world_content();
  void publish_frames_if_due();
  void keep_house();
  [[nodiscard]] AnswerHead head() const;
  void fill_status(const WorldStatus& status);
  void add_counters();

  const PublicationOptions options_;
  const Clock& clock_;
  Inbox& inbox_;
  Outbox& outbox_;
  const SharedCounters& shared_;
  const Nanoseconds started_;

  Picture picture_;
  dds::Publisher publisher_;
  MotionPort motions_;
  CollisionPort collisions_;
  ZonePort zones_;
  FramePort frames_;
  BodyPort watched_;
  ScenePort scene_;
  dds::Writer<wire::Status> status_writer_;
  Mailboxes mailboxes_;
  Transfers transfers_;
  std::deque<PictureQuery> picture_queries_;    ///< until there is room for their answers
  std::weak_ptr<AnswerContent> world_content_;  ///< shared by those who ask at the same moment
  Moment world_moment_;
  std::uint64_t world_number_ = 0;

  wire::Status status_{};
  std::vector<wire::Counter> counters_;
  std::uint64_t collisions_lost_ = 0;
  std::uint64_t zone_events_lost_ = 0;
  std::uint64_t records_put_off_ = 0;
  std::uint64_t replies_failed_ = 0;
  FrameTimes frame_times_;
  Nanoseconds next_housekeeping_{0};
};

}  // namespace stoss::service
