// SPDX-License-Identifier: Apache-2.0
#include "bytes.hpp"
#include "cores.hpp"

#include <stoss/wide/world.hpp>

namespace stoss::wide {

using engine::Arithmetic;

bool is_available(Arithmetic arithmetic) {
#ifdef STOSS_HAVE_QUADMATH
  return arithmetic <= Arithmetic::Float128;
#else
  return arithmetic < Arithmetic::Float128;
#endif
}

engine::World make_world(const engine::WorldOptions& options) {
  switch (options.arithmetic) {
    case Arithmetic::DoubleDouble:
      return engine::World(make_double_double_core(options));
    case Arithmetic::Float128:
#ifdef STOSS_HAVE_QUADMATH
      return engine::World(make_float128_core(options));
#else
      break;
#endif
    case Arithmetic::Float:
    case Arithmetic::Double:
    case Arithmetic::LongDouble:
      break;
  }
  return engine::World(options);
}

engine::Outcome<engine::World> deserialise(std::span<const std::byte> bytes,
                                           engine::BroadPhaseKind broad_phase) {
  engine::ByteSource source(bytes);
  source.word();  // magic and format are checked by restore()
  source.word();
  const std::uint64_t arithmetic = source.word();
  if (arithmetic <= static_cast<std::uint64_t>(Arithmetic::LongDouble) ||
      arithmetic > static_cast<std::uint64_t>(Arithmetic::Float128)) {
    return engine::World::deserialise(bytes, broad_phase);
  }
  if (!is_available(static_cast<Arithmetic>(arithmetic))) {
    return engine::Reject{.code = engine::Code::Unimplemented,
                          .field = "bytes",
                          .reason = "this build has no such arithmetic"};
  }
  engine::World world = make_world(
      {.start = {}, .arithmetic = static_cast<Arithmetic>(arithmetic), .broad_phase = broad_phase});
  if (const auto restored = world.core().restore(bytes); !restored) return restored.reject();
  return world;
}

}  // namespace stoss::wide
