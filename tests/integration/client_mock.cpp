// SPDX-License-Identifier: Apache-2.0
// A client of the end-to-end test, in a process of its own: it commands and asks, listens to
// everything, and compares what it hears with its replica, bit for bit. It speaks with the test
// over standard input and output, line by line:
//
//   -> ready              connected, the replica complete
//   <- go                 now send commands for the time given
//   -> loaded             every command is answered
//   <- check EPOCH NUMBER the world is paused after this motion batch: compare everything
//   -> KEY VALUE...       the findings
//   -> end
#include "client_digest.hpp"

#include <stoss/client/feeds.hpp>
#include <stoss/client/replica.hpp>
#include <stoss/client/session.hpp>

#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace stoss::tests {
namespace {

using namespace stoss::client;
using std::chrono::steady_clock;

/// Of the gas, these are commanded; the others are asked about, so that no command can lie between
/// an answer and the batch of the same instant.
constexpr engine::Id kCommandedMax = 9000;
constexpr engine::Id kAskedFirst = 9001;
constexpr std::uint64_t kAskedCount = 64;
/// A full comparison costs a pass over the world, so only every seventh tick is digested: frames
/// come every third, and some of them are met whichever those are.
constexpr std::uint64_t kDigestEvery = 7;
constexpr std::uint64_t kCollisionBlock = 1000;
constexpr Milliseconds kPatience{20'000};

/// What the replica saw, by instant: for comparing with what comes by other ways, sooner or later.
class Seen {
 public:
  using Key = std::pair<std::int64_t, std::uint64_t>;
  static Key key(const engine::Instant& at) { return {at.seconds, at.fraction}; }

  void on_tick(const ReplicaModel& model) {
    const ReplicaStamp& stamp = model.stamp();
    BitDigest asked;
    for (engine::Id id = kAskedFirst; id < kAskedFirst + kAskedCount; ++id) {
      const engine::BodyState state = model.disk_at(*model.find(id), stamp.at);
      asked.add(id, state.position, state.velocity);
    }
    std::uint64_t whole = 0;
    if (stamp.tick % kDigestEvery == 0) whole = digest_of(model, stamp.at);
    const std::lock_guard lock(mutex_);
    asked_[key(stamp.at)].insert(asked.value());
    if (whole != 0) whole_[key(stamp.at)].insert(whole);
    if (stamp.state_hash != 0) hashes_[stamp.number] = stamp.state_hash;
  }

  static std::uint64_t digest_of(const ReplicaModel& model, const engine::Instant& at) {
    BitDigest digest;
    model.for_each([&](const ReplicaBody& body) {
      if (body.body.is_wall) return;
      const engine::BodyState state = model.disk_at(body, at);
      digest.add(state.id, state.position, state.velocity);
    });
    return digest.value();
  }

  /// 1 when the replica had these bits at that instant, -1 when it had others, 0 when it had not
  /// been looked at there.
  int compare_whole(const engine::Instant& at, std::uint64_t digest) const {
    return compare(whole_, at, digest);
  }
  int compare_asked(const engine::Instant& at, std::uint64_t digest) const {
    return compare(asked_, at, digest);
  }

  std::map<std::uint64_t, std::uint64_t> hashes() const {
    const std::lock_guard lock(mutex_);
    return hashes_;
  }

 private:
  using Table = std::map<Key, std::set<std::uint64_t>>;
  int compare(const Table& table, const engine::Instant& at, std::uint64_t digest) const {
    const std::lock_guard lock(mutex_);
    const auto found = table.find(key(at));
    if (found == table.end()) return 0;
    return found->second.contains(digest) ? 1 : -1;
  }

  mutable std::mutex mutex_;
  Table whole_;
  Table asked_;
  std::map<std::uint64_t, std::uint64_t> hashes_;
};

/// Something heard that is to be compared once the replica is there too.
struct Heard {
  engine::Instant at;
  std::uint64_t digest = 0;
};

/// The collisions, checked for order and digested in blocks by number.
class CollisionWatch {
 public:
  explicit CollisionWatch(Session& session)
      : feed_(session), thread_([this] {
          while (!stop_) {
            if (auto run = feed_.next(Milliseconds{50})) take(*run);
          }
        }) {}
  ~CollisionWatch() { finish(); }

  void finish() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] bool matched() const { return feed_.matched(); }

  void report() const {
    std::printf(
        "collisions %llu\ncollisions_out_of_order %llu\ncollision_gaps %llu\n"
        "collisions_lost %llu\ncollision_first %llu\ncollision_last %llu\n",
        as_long(count_),
        as_long(out_of_order_),
        as_long(feed_.counters().gaps),
        as_long(feed_.counters().lost),
        as_long(first_),
        as_long(last_));
    for (const auto& [block, digest] : blocks_) {
      std::printf("block %llu %llu\n", as_long(block), as_long(digest));
    }
  }
  static unsigned long long as_long(std::uint64_t value) { return value; }

 private:
  void take(const CollisionRun& run) {
    for (const engine::Collision& collision : run.collisions) {
      if (first_ == 0) first_ = collision.sequence;
      const bool follows = last_ == 0 || collision.sequence == last_ + 1;
      const bool in_time = last_ == 0 || collision.instant >= instant_;
      if (!follows || !in_time) ++out_of_order_;
      last_ = collision.sequence;
      instant_ = collision.instant;
      ++count_;
      if ((collision.sequence - 1) % kCollisionBlock == 0) {
        digest_ = {};
        digesting_ = true;
      }
      digest_.add(collision);
      if (digesting_ && collision.sequence % kCollisionBlock == 0) {
        blocks_[collision.sequence / kCollisionBlock] = digest_.value();
      }
    }
  }

  CollisionFeed feed_;
  std::atomic<bool> stop_{false};
  std::uint64_t count_ = 0;
  std::uint64_t out_of_order_ = 0;
  std::uint64_t first_ = 0;
  std::uint64_t last_ = 0;
  engine::Instant instant_;
  BitDigest digest_;
  bool digesting_ = false;
  std::map<std::uint64_t, std::uint64_t> blocks_;
  std::thread thread_;  // last: it uses the others
};

/// The frames, each digested as the replica's ticks are.
class FrameWatch {
 public:
  explicit FrameWatch(Session& session)
      : feed_(session), thread_([this] {
          while (!stop_) {
            if (auto frame = feed_.next(Milliseconds{50})) take(std::move(*frame));
          }
        }) {}
  ~FrameWatch() { finish(); }
  void finish() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] const std::vector<Heard>& heard() const { return heard_; }

 private:
  void take(Frame frame) {
    if (frame.tick % kDigestEvery != 0) return;
    std::sort(frame.bodies.begin(), frame.bodies.end(), [](const FrameBody& a, const FrameBody& b) {
      return a.id < b.id;
    });
    BitDigest digest;
    for (const FrameBody& body : frame.bodies) digest.add(body.id, body.position, body.velocity);
    heard_.push_back({frame.at, digest.value()});
  }

  FrameFeed feed_;
  std::atomic<bool> stop_{false};
  std::vector<Heard> heard_;
  std::thread thread_;  // last: it uses the others
};

/// How the commands fared.
struct Tally {
  std::mutex mutex;
  std::condition_variable changed;
  std::uint64_t sent = 0;
  std::uint64_t answered = 0;
  std::uint64_t unanswered = 0;
  std::uint64_t wrong_instant = 0;  ///< at another instant than asked for, or going back in time
  std::uint64_t wrong_code = 0;
  std::map<engine::Code, std::uint64_t> codes;
  std::map<std::uint64_t, engine::Instant> untimed;  ///< of the untimed, by order of sending
  std::vector<engine::Id> own;                       ///< disks that this client has made
};

class Load {
 public:
  Load(Session& session, Replica& replica, unsigned index)
      : session_(session), replica_(replica), index_(index), random_(1000 + index) {}

  void run(std::chrono::duration<double> time) {
    const auto end = steady_clock::now() + time;
    while (steady_clock::now() < end) {
      command();
      if (tally_.sent % 4 == 0) ask();
      std::this_thread::sleep_for(Milliseconds{20});
    }
    std::unique_lock lock(tally_.mutex);
    tally_.changed.wait_for(lock, kPatience, [this] { return tally_.answered == tally_.sent; });
    check_order();
  }

  [[nodiscard]] const std::vector<Heard>& answers() const { return answers_; }

  void report() {
    const std::lock_guard lock(tally_.mutex);
    const auto code = [this](engine::Code c) { return CollisionWatch::as_long(tally_.codes[c]); };
    std::printf(
        "sent %llu\nanswered %llu\nunanswered %llu\nwrong_instant %llu\nwrong_code %llu\n"
        "ok %llu\noverlap %llu\nnot_found %llu\ndeadline_passed %llu\n"
        "questions_failed %llu\n",
        CollisionWatch::as_long(tally_.sent),
        CollisionWatch::as_long(tally_.answered),
        CollisionWatch::as_long(tally_.unanswered),
        CollisionWatch::as_long(tally_.wrong_instant),
        CollisionWatch::as_long(tally_.wrong_code),
        code(engine::Code::Ok),
        code(engine::Code::Overlap),
        code(engine::Code::NotFound),
        code(engine::Code::DeadlinePassed),
        CollisionWatch::as_long(questions_failed_));
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// One of each kind of command in turn, most of them good.
  void command() {
    const engine::Id target = 1 + random_() % kCommandedMax;
    switch (tally_.sent % 8) {
      case 0:
      case 1: {  // outside the box, each client in a place of its own
        const engine::DiskSpec disk{
            .position = {1000.0 * (index_ + 1) + static_cast<double>(tally_.sent) * 2, -1000},
            .velocity = {0, uniform(-1, 0)},
            .radius = 0.5};
        send(Command::spawn({disk}), engine::Code::Ok);
        break;
      }
      case 2: {  // into the gas, where there may or may not be room
        const engine::DiskSpec disk{.position = {uniform(5, 190), uniform(5, 190)},
                                    .velocity = {uniform(-1, 1), uniform(-1, 1)},
                                    .radius = 0.1};
        send(Command::spawn({disk}), std::nullopt);
        break;
      }
      case 3: {
        Command later = Command::set_velocity({{target, {uniform(-1, 1), uniform(-1, 1)}}});
        const auto at = engine::offset_by(replica_.stamp().at, 0.25 + uniform(0, 0.1));
        send(later.at(*at), std::nullopt, *at);
        break;
      }
      case 4: {
        Command past = Command::set_velocity({{target, {0, 0}}});
        send(past.at({0, 1}), engine::Code::DeadlinePassed);
        break;
      }
      case 5:
        send(Command::remove({987654321}), engine::Code::NotFound);
        break;
      case 6: {
        const engine::Id mine = take_own();
        if (mine != engine::kNoId) send(Command::remove({mine}), engine::Code::Ok);
        [[fallthrough]];
      }
      default:
        send(Command::set_velocity({{target, {uniform(-1, 1), uniform(-1, 1)}}}), engine::Code::Ok);
        break;
    }
  }

  engine::Id take_own() {
    const std::lock_guard lock(tally_.mutex);
    if (tally_.own.empty()) return engine::kNoId;
    const engine::Id id = tally_.own.back();
    tally_.own.pop_back();
    return id;
  }

  void send(const Command& command,
            std::optional<engine::Code> expected,
            std::optional<engine::Instant> at = std::nullopt) {
    std::uint64_t order = 0;
    {
      const std::lock_guard lock(tally_.mutex);
      order = ++tally_.sent;
    }
    const bool timed = command.spec().at.has_value();
    session_.submit(command, kPatience, [this, expected, at, timed, order](Result<Reply> reply) {
      const std::lock_guard lock(tally_.mutex);
      ++tally_.answered;
      if (!reply && !reply.failure().answered) ++tally_.unanswered;
      const engine::Code code = reply ? engine::Code::Ok : reply.failure().reject.code;
      ++tally_.codes[code];
      if (expected && code != *expected) ++tally_.wrong_code;
      // An instant a quarter of a second ahead may have passed on a machine this busy.
      if (at && code != engine::Code::Ok && code != engine::Code::DeadlinePassed) {
        ++tally_.wrong_code;
      }
      if (at && reply && reply.value().at != *at) ++tally_.wrong_instant;
      if (!timed && reply) tally_.untimed[order] = reply.value().at;
      if (reply) {
        tally_.own.insert(tally_.own.end(), reply.value().ids.begin(), reply.value().ids.end());
      }
      tally_.changed.notify_all();
    });
  }

  /// Commands of one client take effect in the order in which it sent them. REQUIRES: the lock.
  void check_order() {
    std::optional<engine::Instant> last;
    for (const auto& [order, at] : tally_.untimed) {
      if (last && at < *last) ++tally_.wrong_instant;
      last = at;
    }
  }

  /// From the world itself, not from what its publisher holds.
  void ask() {
    std::vector<engine::Id> ids;
    for (engine::Id id = kAskedFirst; id < kAskedFirst + kAskedCount; ++id) ids.push_back(id);
    const Result<Answer> answer = session_.ask(Query::states(ids), kPatience);
    if (!answer) {
      ++questions_failed_;
      return;
    }
    BitDigest digest;
    for (const FoundBody& body : answer.value().bodies) {
      digest.add(body.state.id, body.state.position, body.state.velocity);
    }
    answers_.push_back({answer.value().at, digest.value()});
  }

  Session& session_;
  Replica& replica_;
  unsigned index_;
  std::mt19937_64 random_;
  Tally tally_;
  std::vector<Heard> answers_;
  std::uint64_t questions_failed_ = 0;
};

/// The replica, the exact world that the daemon sends, and the world itself, all at one instant.
std::uint64_t count_final_differences(Session& session, const Replica& replica) {
  const Replica::Snapshot ours = replica.snapshot();
  const Result<Answer> whole = session.ask(Query::world(), kPatience);
  const Result<Answer> region = session.ask(Query::region({-1e9, -1e9}, {1e9, 1e9}), kPatience);
  if (!whole || !region) return ~std::uint64_t{0};
  std::uint64_t differences = ours.bodies.size() == whole.value().motions.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(ours.bodies.size(), whole.value().motions.size()); ++i) {
    BitDigest a;
    a.add(ours.bodies[i].motion);
    a.add(ours.bodies[i].body);
    BitDigest b;
    b.add(whole.value().motions[i]);
    b.add(whole.value().statics[i]);
    if (a.value() != b.value()) ++differences;
  }
  std::map<engine::Id, std::uint64_t> theirs;
  for (const FoundBody& body : region.value().bodies) {
    BitDigest digest;
    digest.add(body.state.id, body.state.position, body.state.velocity);
    theirs[body.state.id] = digest.value();
  }
  const std::vector<engine::BodyState> disks = replica.disks(region.value().at);
  if (disks.size() != theirs.size()) ++differences;
  for (const engine::BodyState& state : disks) {
    BitDigest digest;
    digest.add(state.id, state.position, state.velocity);
    if (theirs[state.id] != digest.value()) ++differences;
  }
  return differences;
}

void report_comparison(const char* name,
                       const std::vector<Heard>& heard,
                       const Seen& seen,
                       int (Seen::*compare)(const engine::Instant&, std::uint64_t) const) {
  std::uint64_t equal = 0;
  std::uint64_t different = 0;
  for (const Heard& one : heard) {
    const int result = (seen.*compare)(one.at, one.digest);
    if (result > 0) ++equal;
    if (result < 0) ++different;
  }
  std::printf("%s_equal %llu\n%s_different %llu\n",
              name,
              CollisionWatch::as_long(equal),
              name,
              CollisionWatch::as_long(different));
}

void say(const char* line) {
  std::printf("%s\n", line);
  std::fflush(stdout);
}

std::string hear() {
  std::string line;
  std::getline(std::cin, line);
  return line;
}

/// Listens to everything and does nothing else; for being stopped or killed.
int listen_only(Session& session) {
  MotionFeed motions(session);
  FrameFeed frames(session);
  CollisionFeed collisions(session);
  say("ready");
  for (;;) {
    while (motions.next(Milliseconds{10})) {
    }
    static_cast<void>(frames.next(Milliseconds{0}).has_value());
    static_cast<void>(collisions.next(Milliseconds{0}).has_value());
  }
}

int play(Session& session, unsigned index, double seconds) {
  Seen seen;
  Replica replica(session,
                  {.on_tick = [&seen](const ReplicaModel& model) { seen.on_tick(model); }});
  CollisionWatch collisions(session);
  FrameWatch frames(session);
  Load load(session, replica, index);
  if (!replica.wait_until_complete(kPatience)) return 3;
  say("ready");
  if (hear() != "go") return 4;
  load.run(std::chrono::duration<double>(seconds));
  say("loaded");
  std::istringstream check(hear());
  std::string word;
  std::uint64_t epoch = 0;
  std::uint64_t number = 0;
  check >> word >> epoch >> number;
  if (word != "check" || !replica.wait_for_number(epoch, number, kPatience)) return 5;
  std::printf("final_differences %llu\n",
              CollisionWatch::as_long(count_final_differences(session, replica)));
  std::this_thread::sleep_for(Milliseconds{300});  // for the last frame and collisions to arrive
  frames.finish();
  collisions.finish();
  load.report();
  collisions.report();
  report_comparison("frames", frames.heard(), seen, &Seen::compare_whole);
  report_comparison("answers", load.answers(), seen, &Seen::compare_asked);
  const ReplicaCounters counters = replica.counters();
  std::printf(
      "loads %llu\nreplica_gaps %llu\ncontradictions %llu\nticks %llu\nlast_number %llu\n"
      "stray_replies %llu\nretries %llu\n",
      CollisionWatch::as_long(counters.loads),
      CollisionWatch::as_long(counters.gaps),
      CollisionWatch::as_long(counters.contradictions),
      CollisionWatch::as_long(seen.hashes().size()),
      CollisionWatch::as_long(replica.stamp().number),
      CollisionWatch::as_long(session.counters().stray_replies),
      CollisionWatch::as_long(session.counters().retries));
  for (const auto& [batch, hash] : seen.hashes()) {
    std::printf("hash %llu %llu\n", CollisionWatch::as_long(batch), CollisionWatch::as_long(hash));
  }
  say("end");
  return 0;
}

}  // namespace
}  // namespace stoss::tests

int main(int argc, char** argv) {
  using namespace stoss::tests;
  if (argc != 5) return 2;
  try {
    stoss::client::ConnectOptions options;
    options.domain = static_cast<std::uint32_t>(std::atoi(argv[1]));
    options.world = argv[2];
    options.timeout = kPatience;
    stoss::client::Session session(options);
    const std::string index = argv[3];
    if (index == "listener") return listen_only(session);
    return play(session, static_cast<unsigned>(std::stoul(index)), std::atof(argv[4]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mock client: %s\n", error.what());
    return 1;
  }
}
