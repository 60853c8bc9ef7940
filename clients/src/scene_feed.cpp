// SPDX-License-Identifier: Apache-2.0
#include "topic_feed.hpp"

#include <stoss/client/feeds.hpp>
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/basics.hpp>

#include <algorithm>
#include <map>

namespace stoss::client {

namespace wire = idl::wire;

namespace {

bool consistent(const wire::SceneChunk& chunk) {
  const auto all = [](std::size_t rows, std::initializer_list<std::size_t> lengths) {
    return std::all_of(
        lengths.begin(), lengths.end(), [rows](std::size_t length) { return length == rows; });
  };
  return all(chunk.disk_id._length,
             {chunk.disk_kind._length, chunk.disk_radius._length, chunk.disk_mass._length}) &&
         all(chunk.wall_id._length,
             {chunk.wall_start_x._length,
              chunk.wall_start_y._length,
              chunk.wall_end_x._length,
              chunk.wall_end_y._length,
              chunk.wall_vx._length,
              chunk.wall_vy._length}) &&
         all(chunk.zone_id._length,
             {chunk.zone_x._length, chunk.zone_y._length, chunk.zone_radius._length});
}

SceneImage image_of(const wire::SceneChunk& chunk) {
  SceneImage image;
  image.epoch = chunk.epoch;
  image.version = chunk.version;
  image.world = idl::text(chunk.world);
  image.scene_name = idl::text(chunk.scene_name);
  image.at = translate::to_engine(chunk.at);
  image.period = {chunk.period_x, chunk.period_y};
  for (const auto& effect : idl::view(chunk.effects)) {
    image.effects.emplace_back(idl::text(effect));
  }
  for (std::size_t i = 0; i < chunk.disk_id._length; ++i) {
    image.disks.push_back(
        {chunk.disk_id._buffer[i],
         translate::body_kind_of(chunk.disk_kind._buffer[i]).value_or(engine::BodyKind::Static),
         chunk.disk_radius._buffer[i],
         chunk.disk_mass._buffer[i]});
  }
  for (std::size_t i = 0; i < chunk.wall_id._length; ++i) {
    image.walls.push_back({chunk.wall_id._buffer[i],
                           image.at,
                           {chunk.wall_start_x._buffer[i], chunk.wall_start_y._buffer[i]},
                           {chunk.wall_end_x._buffer[i], chunk.wall_end_y._buffer[i]},
                           {chunk.wall_vx._buffer[i], chunk.wall_vy._buffer[i]}});
  }
  for (std::size_t i = 0; i < chunk.zone_id._length; ++i) {
    image.zones.push_back({chunk.zone_id._buffer[i],
                           {chunk.zone_x._buffer[i], chunk.zone_y._buffer[i]},
                           chunk.zone_radius._buffer[i]});
  }
  for (const wire::Name& name : idl::view(chunk.names)) {
    image.names.emplace_back(name.of, std::string(idl::text(name.text)));
  }
  return image;
}

template <class T>
void add_to(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

class SceneFeed::Impl {
 public:
  explicit Impl(const Session& session) : feed(session, idl::kSceneTopic) {}

  void add(const wire::SceneChunk& chunk) {
    if (!consistent(chunk) || chunk.chunk >= chunk.chunks) return;
    if (chunk.epoch < epoch || (chunk.epoch == epoch && chunk.version < version)) return;
    if (chunk.epoch != epoch || chunk.version != version) {
      chunks.clear();
      told = false;
    }
    epoch = chunk.epoch;
    version = chunk.version;
    count = chunk.chunks;
    chunks[chunk.chunk] = image_of(chunk);
  }

  std::optional<SceneImage> take() {
    if (told || chunks.empty() || chunks.size() < count) return std::nullopt;
    told = true;
    SceneImage whole = chunks.begin()->second;
    for (auto it = std::next(chunks.begin()); it != chunks.end(); ++it) {
      add_to(whole.disks, it->second.disks);
      add_to(whole.walls, it->second.walls);
      add_to(whole.zones, it->second.zones);
      add_to(whole.names, it->second.names);
    }
    return whole;
  }

  TopicFeed<wire::SceneChunk> feed;
  std::map<std::uint32_t, SceneImage> chunks;
  std::uint64_t epoch = 0;
  std::uint64_t version = 0;
  std::uint32_t count = 0;
  bool told = false;
};

SceneFeed::SceneFeed(const Session& session) : impl_(std::make_unique<Impl>(session)) {}
SceneFeed::~SceneFeed() = default;
SceneFeed::SceneFeed(SceneFeed&&) noexcept = default;
SceneFeed& SceneFeed::operator=(SceneFeed&&) noexcept = default;

std::optional<SceneImage> SceneFeed::next(Milliseconds timeout) {
  return impl_->feed.wait_for(
      timeout,
      [this](const dds::Sample<wire::SceneChunk>& sample) {
        if (sample.valid()) impl_->add(sample.data);
      },
      [this] { return impl_->take(); });
}

}  // namespace stoss::client
