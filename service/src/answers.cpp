// SPDX-License-Identifier: Apache-2.0
#include "answers.hpp"

#include <stoss/idl/sequence.hpp>

#include <algorithm>
#include <utility>

namespace stoss::service {
namespace {

/// Walls in one chunk; the type's bound would not fit a datagram.
constexpr std::size_t kWallsPerChunk = 896;

std::size_t chunks_for(std::size_t rows, std::size_t per_chunk) {
  return (rows + per_chunk - 1) / per_chunk;
}

// The rows of a table of `size` rows that chunk `chunk` holds.
struct Slice {
  std::size_t first;
  std::size_t count;
};
Slice slice(std::size_t size, std::size_t chunk, std::size_t per_chunk) {
  const std::size_t first = std::min(chunk * per_chunk, size);
  return {first, std::min(per_chunk, size - first)};
}

class Refusal final : public AnswerContent {
 public:
  explicit Refusal(engine::Reject reject) : reject_(std::move(reject)) {}
  std::uint32_t chunks() const override { return 1; }
  void fill(std::uint32_t, wire::Answer& answer) override {
    translate::put_reject(answer, reject_);
  }

 private:
  engine::Reject reject_;
};

// States first, then walls, then hits, each in chunks of their own: together they would not fit.
class RowsContent final : public AnswerContent {
 public:
  explicit RowsContent(Rows rows)
      : rows_(std::move(rows)),
        state_chunks_(chunks_for(rows_.states.size(), stoss_v1_MAX_STATES)),
        wall_chunks_(chunks_for(rows_.walls.size(), kWallsPerChunk)),
        hit_chunks_(chunks_for(rows_.hits.size(), stoss_v1_MAX_HITS)) {}

  std::uint32_t chunks() const override {
    const std::size_t all = state_chunks_ + wall_chunks_ + hit_chunks_;
    return static_cast<std::uint32_t>(std::max<std::size_t>(all, 1));
  }
  void fill(std::uint32_t chunk, wire::Answer& answer) override {
    std::size_t i = chunk;
    if (i < state_chunks_) {
      const Slice rows = slice(rows_.states.size(), i, stoss_v1_MAX_STATES);
      rows_.states.lend(answer.states, rows.first, rows.count);
      return;
    }
    i -= state_chunks_;
    if (i < wall_chunks_) {
      const Slice rows = slice(rows_.walls.size(), i, kWallsPerChunk);
      rows_.walls.lend(answer.walls, rows.first, rows.count);
      return;
    }
    i -= wall_chunks_;
    if (i < hit_chunks_) {
      const Slice rows = slice(rows_.hits.size(), i, stoss_v1_MAX_HITS);
      rows_.hits.lend(answer.hits, rows.first, rows.count);
    }
  }

 private:
  Rows rows_;
  std::size_t state_chunks_;
  std::size_t wall_chunks_;
  std::size_t hit_chunks_;
};

class FeaturesContent final : public AnswerContent {
 public:
  explicit FeaturesContent(const std::vector<std::string>& words) {
    words_.resize(std::min<std::size_t>(words.size(), stoss_v1_MAX_FEATURES));
    for (std::size_t i = 0; i < words_.size(); ++i) idl::assign(words_[i].text, words[i]);
  }
  std::uint32_t chunks() const override { return 1; }
  void fill(std::uint32_t, wire::Answer& answer) override {
    using Element = idl::Element<decltype(answer.features)>;
    static_assert(sizeof(Element) == sizeof(Word));
    answer.features._buffer = &words_.data()->text;
    answer.features._length = static_cast<std::uint32_t>(words_.size());
    answer.features._maximum = answer.features._length;
  }

 private:
  struct Word {
    stoss_v1_ShortText text{};
  };
  std::vector<Word> words_;
};

class StatusContent final : public AnswerContent {
 public:
  explicit StatusContent(const wire::Status& status) : status_(status) {
    const auto counters = idl::view(status.counters);
    counters_.assign(counters.begin(), counters.end());
    idl::lend(status_.counters, counters_);
  }
  std::uint32_t chunks() const override { return 1; }
  void fill(std::uint32_t, wire::Answer& answer) override {
    answer.status._buffer = &status_;
    answer.status._length = 1;
    answer.status._maximum = 1;
  }

 private:
  wire::Status status_;
  std::vector<wire::Counter> counters_;
};

class WorldContent final : public AnswerContent {
 public:
  explicit WorldContent(const Picture& picture) : state_hash_(picture.state_hash()) {
    motions_.reserve(picture.size());
    statics_.reserve(picture.size());
    picture.for_each_in_order([this](const Picture::Body& body) {
      motions_.append(engine::ChangeKind::Spawned, body.motion);
      statics_.append(body.record);
    });
  }
  std::uint32_t chunks() const override {
    const std::size_t chunks = std::max(chunks_for(motions_.size(), stoss_v1_MAX_MOTIONS),
                                        chunks_for(statics_.size(), stoss_v1_MAX_STATICS));
    return static_cast<std::uint32_t>(std::max<std::size_t>(chunks, 1));
  }
  void fill(std::uint32_t chunk, wire::Answer& answer) override {
    // As many motions as statics to a chunk, so that all chunks are of one size.
    const Slice rows = slice(motions_.size(), chunk, stoss_v1_MAX_STATICS);
    motions_.lend(answer.motions, rows.first, rows.count);
    statics_.lend(answer.statics, rows.first, rows.count);
    answer.state_hash = state_hash_;
  }

 private:
  translate::MotionColumns motions_;
  translate::StaticColumns statics_;
  std::uint64_t state_hash_;
};

// Events with numbers, from `first` on.
template <class Columns, std::size_t kPerChunk, auto kBlock>
class EventsContent final : public AnswerContent {
 public:
  template <class Port>
  EventsContent(const Port& port, std::uint64_t first, std::uint64_t count) : first_(first) {
    for (std::uint64_t i = 0; i < count; ++i) columns_.append(port.at(first + i));
  }
  std::uint32_t chunks() const override {
    return static_cast<std::uint32_t>(
        std::max<std::size_t>(chunks_for(columns_.size(), kPerChunk), 1));
  }
  void fill(std::uint32_t chunk, wire::Answer& answer) override {
    const Slice rows = slice(columns_.size(), chunk, kPerChunk);
    columns_.lend(answer.*kBlock, rows.first, rows.count);
    answer.first_number = first_ + rows.first;
  }

 private:
  Columns columns_;
  std::uint64_t first_;
};

template <class Content, class Port>
std::shared_ptr<AnswerContent> events_content(const std::string& what,
                                              const Port& port,
                                              std::uint64_t first,
                                              std::uint64_t count) {
  if (first == 0) {
    return make_content(engine::Reject{.code = engine::Code::InvalidArgument,
                                       .field = "number",
                                       .reason = what + " are numbered from 1"});
  }
  if (first < port.oldest()) {
    return make_content(engine::Reject{
        .code = engine::Code::NotFound,
        .field = "number",
        .reason =
            what + " before number " + std::to_string(port.oldest()) + " are no longer kept"});
  }
  const std::uint64_t there = first > port.number() ? 0 : port.number() - first + 1;
  return std::make_shared<Content>(port, first, count == 0 ? there : std::min(count, there));
}

}  // namespace

std::shared_ptr<AnswerContent> make_content(engine::Reject reject) {
  return std::make_shared<Refusal>(std::move(reject));
}

std::shared_ptr<AnswerContent> make_content(Rows rows) {
  return std::make_shared<RowsContent>(std::move(rows));
}

std::shared_ptr<AnswerContent> make_content(std::vector<std::string> features) {
  return std::make_shared<FeaturesContent>(features);
}

std::shared_ptr<AnswerContent> make_content(const wire::Status& status) {
  return std::make_shared<StatusContent>(status);
}

std::shared_ptr<AnswerContent> list_content(const Picture& picture) {
  Rows rows;
  rows.states.reserve(picture.size());
  picture.for_each_in_order([&](const Picture::Body& body) {
    if (body.record.is_wall) {
      rows.walls.append(picture.wall_of(body));
    } else {
      rows.states.append(picture.state_of(body));
    }
  });
  return make_content(std::move(rows));
}

std::shared_ptr<AnswerContent> world_content(const Picture& picture) {
  return std::make_shared<WorldContent>(picture);
}

std::shared_ptr<AnswerContent> collisions_content(const CollisionPort& port,
                                                  std::uint64_t first,
                                                  std::uint64_t count) {
  using Content = EventsContent<translate::CollisionColumns,
                                stoss_v1_MAX_COLLISIONS,
                                &wire::Answer::collisions>;
  return events_content<Content>("collisions", port, first, count);
}

std::shared_ptr<AnswerContent> zone_events_content(const ZonePort& port,
                                                   std::uint64_t first,
                                                   std::uint64_t count) {
  using Content = EventsContent<translate::ZoneEventColumns,
                                stoss_v1_MAX_ZONE_EVENTS,
                                &wire::Answer::zone_events>;
  return events_content<Content>("zone events", port, first, count);
}

}  // namespace stoss::service
