// SPDX-License-Identifier: Apache-2.0
#include "transfers.hpp"

#include <algorithm>
#include <utility>

namespace stoss::service {

void Transfers::start(const RequestId& request,
                      const AnswerHead& head,
                      std::shared_ptr<AnswerContent> content,
                      Ticket ticket,
                      Nanoseconds now) {
  Transfer transfer{request, head, std::move(content), std::move(ticket), 0, 0, now};
  if (!advance(transfer, now)) transfers_.push_back(std::move(transfer));
}

bool Transfers::is_underway(const RequestId& request) const {
  return std::any_of(transfers_.begin(), transfers_.end(), [&](const Transfer& transfer) {
    return transfer.request == request;
  });
}

bool Transfers::pump(Nanoseconds now) {
  std::erase_if(transfers_, [&](Transfer& transfer) { return advance(transfer, now); });
  return !transfers_.empty();
}

bool Transfers::advance(Transfer& transfer, Nanoseconds now) {
  Mailbox* const mailbox = mailboxes_.of(transfer.request.client, now);
  const std::uint32_t chunks = transfer.content->chunks();
  const bool small = chunks <= static_cast<std::uint32_t>(idl::kAnswerReplay);
  // A small answer is kept for a client that has not found its mailbox yet, a large one is not.
  const bool ready = mailbox != nullptr && (small || mailbox->answer.readers() > 0);
  if (ready) {
    if (transfer.in_flight > 0 && mailbox->answer.wait_for_acknowledgments(Nanoseconds::zero())) {
      transfer.in_flight = 0;
    }
    const std::uint32_t burst = small ? chunks : kBurstChunks;
    for (std::uint32_t i = 0;
         i < burst && transfer.next < chunks && transfer.in_flight < kWindowChunks;
         ++i) {
      static_cast<void>(write_chunk(transfer, *mailbox));
      ++transfer.next;
      ++transfer.in_flight;
      transfer.progress = now;
    }
    if (transfer.next == chunks) return true;
  }
  if (now - transfer.progress < kTransferPatience) return false;
  ++abandoned_;
  return true;
}

bool Transfers::write_chunk(Transfer& transfer, Mailbox& mailbox) {
  wire::Answer answer{};
  answer.request = translate::to_wire(transfer.request);
  answer.chunk = transfer.next;
  answer.chunks = transfer.content->chunks();
  answer.epoch = transfer.head.moment.epoch;
  answer.at = translate::to_wire(transfer.head.moment.at);
  answer.tick = transfer.head.moment.tick;
  answer.motion_number = transfer.head.motion_number;
  answer.collision_number = transfer.head.collision_number;
  answer.zone_number = transfer.head.zone_number;
  transfer.content->fill(transfer.next, answer);
  return mailbox.answer.write(answer);
}

}  // namespace stoss::service
