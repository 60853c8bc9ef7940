// SPDX-License-Identifier: Apache-2.0
#include <stoss/idl/topics.hpp>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace stoss::idl {
namespace {

using dds::Qos;

// A client may wait this long for the daemon to take its commands in; then the write fails and says
// so.
constexpr std::chrono::milliseconds kClientMaxBlock{100};

// The daemon's writers keep the last n and so never block; the zero makes a mistake here visible.
constexpr std::chrono::nanoseconds kNever{0};

}  // namespace

dds::Qos writer_qos(TopicId topic) {
  switch (topic) {
    case TopicId::kCommand:
    case TopicId::kQuery:
      return Qos().reliable(kClientMaxBlock).keep_all().volatile_durability();
    // The daemon makes a mailbox's writers at a client's first request. Transient-local, because
    // the client may find the writer only after the first reply was written.
    case TopicId::kReply:
      return Qos().reliable(kNever).keep_last(kReplyDepth).transient_local(kReplyReplay);
    case TopicId::kAnswer:
      return Qos().reliable(kNever).keep_last(kAnswerDepth).transient_local(kAnswerReplay);
    case TopicId::kMotion:
    case TopicId::kCollision:
    case TopicId::kZone:
      return Qos().reliable(kNever).keep_last(kBatchDepth).volatile_durability();
    case TopicId::kBody:
      return Qos().reliable(kNever).keep_last(1).volatile_durability();
    case TopicId::kFrame:
    case TopicId::kScene:
    case TopicId::kStatus:
      return Qos().reliable(kNever).keep_last(1).transient_local(1);
  }
  throw std::invalid_argument("no such topic");
}

dds::Qos reader_qos(TopicId topic) {
  switch (topic) {
    // Kept whole, and never limited: a reader that is full stops Cyclone's receive thread and with
    // it every other topic. Both sides drain these at once.
    case TopicId::kCommand:
    case TopicId::kQuery:
      return Qos().reliable(kNever).keep_all().volatile_durability();
    case TopicId::kReply:
    case TopicId::kAnswer:
      return Qos().reliable(kNever).keep_all().transient_local(1);
    case TopicId::kMotion:
    case TopicId::kCollision:
    case TopicId::kZone:
      return Qos().reliable(kNever).keep_last(kBatchDepth).volatile_durability();
    case TopicId::kBody:
      return Qos().reliable(kNever).keep_last(1).volatile_durability();
    case TopicId::kFrame:
    case TopicId::kScene:
    case TopicId::kStatus:
      return Qos().reliable(kNever).keep_last(1).transient_local(1);
  }
  throw std::invalid_argument("no such topic");
}

bool valid_world_name(std::string_view world) noexcept {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !world.empty() && world.size() <= stoss_v1_MAX_NAME_LENGTH &&
         std::all_of(world.begin(), world.end(), allowed);
}

std::string partition_of(std::string_view world) {
  if (!valid_world_name(world)) {
    throw std::invalid_argument("world name \"" + std::string(world) +
                                "\" must be 1 to 64 letters, digits, '.', '_' or '-'");
  }
  return std::string(world);
}

std::string mailbox_of(std::string_view world, const std::array<std::uint8_t, 16>& client) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string partition = partition_of(world) + '/';
  for (const std::uint8_t byte : client) {
    partition += kDigits[byte / 16U];
    partition += kDigits[byte % 16U];
  }
  return partition;
}

std::string mailbox_of(std::string_view world, const wire::RequestId& request) {
  return mailbox_of(world, std::to_array(request.client));
}

}  // namespace stoss::idl
