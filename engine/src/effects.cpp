// SPDX-License-Identifier: Apache-2.0
#include <stoss/engine/effects.hpp>

#include <cmath>
#include <string>

namespace stoss::engine {
namespace {

constexpr double kPullMax = 1e100;  // m/s^2; chosen: squares of what it does in a year stay finite
/// J; chosen: the speeds of the lightest disk that a world in float takes stay in its range.
constexpr double kTemperatureMax = 1e25;
/// 1/s; chosen: waits stay far above the resolution of an Instant.
constexpr double kKickRateMax = 1e9;

std::optional<Reject> in_range(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return std::nullopt;
  std::string reason = "must be ";
  if (std::isfinite(high)) {
    reason += "in [" + std::to_string(static_cast<int>(low)) + ", " +
              std::to_string(static_cast<int>(high)) + "]";
  } else {
    reason += "at least " + std::to_string(static_cast<int>(low)) + " and finite";
  }
  return Reject{.code = Code::InvalidArgument, .field = field, .reason = std::move(reason)};
}

std::optional<Reject> not_negative(const char* field, double value) {
  if (std::isinf(value)) value = -1;
  return in_range(field, value, 0, HUGE_VAL);
}

}  // namespace

std::optional<Reject> check_effects(const Effects& effects) {
  if (effects.gravity && !(effects.gravity->acceleration.cwiseAbs().maxCoeff() <= kPullMax)) {
    return Reject{.code = Code::InvalidArgument,
                  .field = "gravity.acceleration",
                  .reason = "must be finite, and at most 1e100 m/s^2"};
  }
  if (const auto& friction = effects.floor_friction) {
    if (auto reject = not_negative("floor_friction.deceleration", friction->deceleration)) {
      return reject;
    }
    if (effects.gravity) {
      return Reject{.code = Code::Unimplemented,
                    .field = "floor_friction",
                    .reason = "together with gravity in the plane has no closed form"};
    }
  }
  if (const auto& restitution = effects.restitution) {
    if (auto reject = in_range("restitution.coefficient", restitution->coefficient, 0, 1)) {
      return reject;
    }
    if (auto reject =
            in_range("restitution.wall_coefficient", restitution->wall_coefficient, 0, 1)) {
      return reject;
    }
    if (auto reject = not_negative("restitution.contact_duration", restitution->contact_duration)) {
      return reject;
    }
    if (auto reject = not_negative("restitution.rest_speed", restitution->rest_speed))
      return reject;
    if (restitution->rest_speed > 0 && !effects.gravity) {
      return Reject{.code = Code::Unimplemented,
                    .field = "restitution.rest_speed",
                    .reason = "nothing comes to rest without gravity"};
    }
  }
  if (const auto& rough = effects.rough) {
    if (auto reject =
            in_range("rough.tangential_restitution", rough->tangential_restitution, -1, 1)) {
      return reject;
    }
    if (auto reject = not_negative("rough.friction", rough->friction)) return reject;
    if (effects.gravity) {
      return Reject{.code = Code::Unimplemented,
                    .field = "rough",
                    .reason =
                        "a rough disk that gravity holds on a wall would roll, which has no "
                        "treatment yet"};
    }
  }
  if (const auto& thermostat = effects.thermostat) {
    if (!(thermostat->temperature >= 0 && thermostat->temperature <= kTemperatureMax)) {
      return Reject{.code = Code::InvalidArgument,
                    .field = "thermostat.temperature",
                    .reason = "must be in [0, 1e25] J"};
    }
    if (!(thermostat->rate >= 0 && thermostat->rate <= kKickRateMax)) {
      return Reject{.code = Code::InvalidArgument,
                    .field = "thermostat.rate",
                    .reason = "must be in [0, 1e9] per second"};
    }
  }
  return std::nullopt;
}

}  // namespace stoss::engine
