// SPDX-License-Identifier: Apache-2.0
// The words that the engine and the wire share, one function a pair. This room alone knows both.
#pragma once

#include <stoss/engine/outcome.hpp>
#include <stoss/engine/types.hpp>
#include <stoss/idl/types.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stoss::translate {

namespace wire = idl::wire;

using ClientId = std::array<std::uint8_t, 16>;

/// Who asks, and which of its requests this is. Ordered by client, then number.
struct RequestId {
  ClientId client{};
  std::uint64_t number = 0;

  friend auto operator<=>(const RequestId&, const RequestId&) = default;
};

[[nodiscard]] RequestId to_engine(const wire::RequestId& request);
[[nodiscard]] wire::RequestId to_wire(const RequestId& request);

[[nodiscard]] engine::Instant to_engine(const wire::Instant& instant);
[[nodiscard]] wire::Instant to_wire(const engine::Instant& instant);

[[nodiscard]] idl::Code to_wire(engine::Code code);
/// Nothing for a code that is newer than this program.
[[nodiscard]] std::optional<engine::Code> code_of(std::uint16_t value);

[[nodiscard]] idl::Arithmetic to_wire(engine::Arithmetic arithmetic);
[[nodiscard]] std::optional<engine::Arithmetic> arithmetic_of(std::uint8_t value);

[[nodiscard]] idl::BodyKind to_wire(engine::BodyKind kind);
/// Nothing for a wall's or an unknown kind.
[[nodiscard]] std::optional<engine::BodyKind> body_kind_of(std::uint8_t value);

[[nodiscard]] idl::Change to_wire(engine::ChangeKind change);
[[nodiscard]] std::optional<engine::ChangeKind> change_of(std::uint8_t value);

[[nodiscard]] idl::CollisionKind to_wire(engine::ContactKind kind);
[[nodiscard]] std::optional<engine::ContactKind> contact_kind_of(std::uint8_t value);

/// The words of `--broad-phase` and of Status.broad_phase: "neighbours", "all-pairs".
[[nodiscard]] std::string_view name_of(engine::BroadPhaseKind kind);
[[nodiscard]] std::optional<engine::BroadPhaseKind> broad_phase_of(std::string_view name);

/// The words of `--scalar`: "float", "double", "long-double", "double-double", "float128".
[[nodiscard]] std::string_view name_of(engine::Arithmetic arithmetic);
[[nodiscard]] std::optional<engine::Arithmetic> arithmetic_of(std::string_view name);

/// A refusal's field as the protocol spells it: "disks[3].radius" becomes "disks.radius", since the
/// element travels in a field of its own.
[[nodiscard]] std::string wire_field(std::string_view field);

/// The refusal of a request in another version of the protocol.
[[nodiscard]] engine::Reject unknown_protocol(std::uint16_t asked);

/// Fills code, reason, field, index, body, other and clearance of a Reply.
void put_reject(wire::Reply& reply, const engine::Reject& reject);
/// Fills code, reason, field and body of an Answer.
void put_reject(wire::Answer& answer, const engine::Reject& reject);

/// The refusal in a received Reply or Answer. REQUIRES: its code is not OK. A code that is newer
/// than this program becomes Internal.
[[nodiscard]] engine::Reject reject_of(const wire::Reply& reply);
[[nodiscard]] engine::Reject reject_of(const wire::Answer& answer);

}  // namespace stoss::translate
