// SPDX-License-Identifier: Apache-2.0
#include <stoss/engine/effects.hpp>
#include <stoss/engine/features.hpp>

#include <charconv>
#include <limits>
#include <string>

namespace stoss::engine {
namespace {

/// A bound of a range, in the fewest digits.
std::string shown(double bound) {
  constexpr std::size_t kRoom = 32;
  char room[kRoom];
  return {room, std::to_chars(room, room + kRoom, bound).ptr};
}

std::string range_of(const EffectParameter& parameter) {
  if (parameter.high < std::numeric_limits<double>::max()) {
    return "must be in [" + shown(parameter.low) + ", " + shown(parameter.high) + "] " +
           (parameter.unit == "1" ? "" : std::string(parameter.unit));
  }
  return "must be at least " + shown(parameter.low) + " and finite";
}

std::optional<Reject> check_range(const EffectParameter& parameter, const Effects& effects) {
  for (int component = 0; component < parameter.components; ++component) {
    const double value = parameter.read(effects, component);
    if (value >= parameter.low && value <= parameter.high) continue;
    return Reject{.code = Code::InvalidArgument,
                  .field = std::string(parameter.effect) + "." + std::string(parameter.name),
                  .reason = range_of(parameter)};
  }
  return std::nullopt;
}

// Chosen: under drag no flight to the end of time leaves the range of the kernels, 2^150.
constexpr double kDragMin = 1e-12;       // 1/s
constexpr double kPullUnderDrag = 1e12;  // m/s^2

std::optional<Reject> check_drag(const Effects& effects) {
  if (!effects.drag || effects.drag->rate == 0) return std::nullopt;
  if (effects.drag->rate < kDragMin) {
    return Reject{.code = Code::InvalidArgument,
                  .field = "drag.rate",
                  .reason = "must be 0 or at least " + shown(kDragMin) + " 1/s"};
  }
  if (effects.gravity && effects.gravity->acceleration.cwiseAbs().maxCoeff() > kPullUnderDrag) {
    return Reject{.code = Code::InvalidArgument,
                  .field = "gravity.acceleration",
                  .reason = "must be at most " + shown(kPullUnderDrag) + " m/s^2 under drag"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Reject> check_effects(const Effects& effects) {
  for (const EffectInfo& effect : known_effects()) {
    if (!effect.is_on(effects)) continue;
    for (const EffectParameter& parameter : effect_parameters()) {
      if (parameter.effect != effect.name || parameter.is_whole) continue;
      if (auto reject = check_range(parameter, effects)) return reject;
    }
    for (const EffectInfo& other : known_effects()) {
      const Refusal* const refusal = find_refusal(effect.name, other.name);
      if (refusal == nullptr || refusal->effect != effect.name || !other.is_on(effects)) continue;
      return Reject{.code = Code::Unimplemented,
                    .field = std::string(refusal->effect),
                    .reason = std::string(refusal->reason)};
    }
  }
  if (auto reject = check_drag(effects)) return reject;
  if (effects.restitution && effects.restitution->rest_speed > 0 && !effects.gravity &&
      !effects.drag) {
    return Reject{.code = Code::Unimplemented,
                  .field = "restitution.rest_speed",
                  .reason = "nothing comes to rest without gravity or drag"};
  }
  return std::nullopt;
}

std::optional<Reject> check_period(const Vector2& period) {
  constexpr double kShortest = 1e-20;  // m; chosen: speeds and places then stay in range of float
  constexpr double kLongest = 1e20;
  const auto check = [&](const char* field, double length) -> std::optional<Reject> {
    if (length == 0 || (length >= kShortest && length <= kLongest)) return std::nullopt;
    return Reject{.code = Code::InvalidArgument,
                  .field = field,
                  .reason = "must be 0 (open), or from 1e-20 to 1e20 m"};
  };
  if (auto reject = check("period.x", period.x())) return reject;
  return check("period.y", period.y());
}

}  // namespace stoss::engine
