// SPDX-License-Identifier: Apache-2.0
#include "double_double.hpp"
#include "effects_bytes.hpp"
#include "world_core.hpp"
#ifdef STOSS_HAVE_QUADMATH
#include "float128.hpp"
#endif

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
      return engine::World(engine::make_core_in<DoubleDouble>(options));
    case Arithmetic::Float128:
#ifdef STOSS_HAVE_QUADMATH
      return engine::World(engine::make_core_in<Float128>(options));
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
  const auto identity = engine::read_identity(source);
  if (!identity || identity->arithmetic <= Arithmetic::LongDouble) {
    return engine::World::deserialise(bytes, broad_phase);
  }
  if (!is_available(identity->arithmetic)) {
    return engine::Reject{.code = engine::Code::Unimplemented,
                          .field = "bytes",
                          .reason = "this build has no such arithmetic"};
  }
  engine::World world = make_world({.start = {},
                                    .arithmetic = identity->arithmetic,
                                    .broad_phase = broad_phase,
                                    .effects = identity->effects,
                                    .period = identity->period});
  if (const auto restored = world.core().restore(bytes); !restored) return restored.reject();
  return world;
}

}  // namespace stoss::wide
