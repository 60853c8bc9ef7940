// SPDX-License-Identifier: Apache-2.0
// The scene topic: what changes rarely, kept for late joiners, in chunks.
#pragma once

#include "clock.hpp"
#include "picture.hpp"
#include "topics.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stoss::service {

/// Changes of the scene are gathered for this long before it is published again.
inline constexpr Nanoseconds kSceneInterval{250'000'000};
/// ... and for so long a body, some five times of what publishing it costs: bodies that come and go
/// in a world of a million must not keep the publisher at nothing else.
inline constexpr Nanoseconds kSceneIntervalPerBody{2'000};

class ScenePort {
 public:
  ScenePort(const dds::Publisher& publisher, const Topics& topics, std::string world)
      : writer_(idl::make_writer(publisher, topics.scene, idl::kSceneTopic)),
        world_(std::move(world)) {}

  /// The scene's own name, for people.
  void set_scene_name(std::string name) { scene_name_ = std::move(name); }
  /// Publishes the scene if it has changed, and not sooner after the last time than the intervals
  /// above say.
  void publish_if_due(const Picture& picture, Nanoseconds now);

  [[nodiscard]] std::uint64_t version() const { return version_; }
  [[nodiscard]] std::uint64_t failures() const { return writer_.failures(); }

 private:
  struct Word {
    stoss_v1_ShortText text{};
  };

  /// The rows of all chunks; a chunk is a slice of each.
  struct Columns {
    std::vector<std::uint64_t> disk_id;
    std::vector<std::uint8_t> disk_kind;
    std::vector<double> disk_radius, disk_mass;
    std::vector<std::uint64_t> wall_id;
    std::vector<double> start_x, start_y, end_x, end_y, vx, vy;
    std::vector<std::uint64_t> zone_id;
    std::vector<double> zone_x, zone_y, zone_radius;
    std::vector<wire::Name> names;
    std::vector<Word> effects;  ///< in every chunk
  };

  void publish(const Picture& picture);
  static Columns columns_of(const Picture& picture);
  void write_chunk(const Picture& picture,
                   Columns& columns,
                   std::uint32_t chunk,
                   std::uint32_t chunks);

  dds::Writer<wire::SceneChunk> writer_;
  std::string world_;
  std::string scene_name_;
  std::uint64_t version_ = 0;
  std::uint64_t published_ = 0;  ///< the picture's scene_version that was published
  std::uint32_t chunks_ = 0;
  Nanoseconds next_{0};
};

}  // namespace stoss::service
