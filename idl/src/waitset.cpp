// SPDX-License-Identifier: Apache-2.0
#include <stoss/dds/waitset.hpp>

#include <algorithm>
#include <utility>

namespace stoss::dds {

void WaitSet::attach_reader(dds_entity_t reader, std::intptr_t tag) {
  Entity condition(dds_create_readcondition(reader, DDS_ANY_STATE), "create read condition");
  const dds_entity_t watched = condition.handle();
  check(dds_waitset_attach(handle(), watched, tag), "attach reader to waitset");
  attachments_.push_back({tag, watched, std::move(condition)});
}

void WaitSet::attach(const Guard& guard, std::intptr_t tag) {
  check(dds_waitset_attach(handle(), guard.handle(), tag), "attach guard to waitset");
  attachments_.push_back({tag, guard.handle(), Entity()});
}

void WaitSet::detach(std::intptr_t tag) noexcept {
  const auto gone = std::stable_partition(
      attachments_.begin(), attachments_.end(), [&](const Attachment& a) { return a.tag != tag; });
  for (auto it = gone; it != attachments_.end(); ++it) {
    static_cast<void>(dds_waitset_detach(handle(), it->watched));
  }
  attachments_.erase(gone, attachments_.end());
}

}  // namespace stoss::dds
