// SPDX-License-Identifier: Apache-2.0
#include <stoss/engine/features.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace stoss::engine {
namespace {

constexpr double kAnyNumber = std::numeric_limits<double>::max();
/// m/s^2; chosen: squares of what it does in a year stay finite.
constexpr double kPullMax = 1e100;
/// J; chosen: the speeds of the lightest disk that a world in float takes stay in its range.
constexpr double kTemperatureMax = 1e25;
/// 1/s; chosen: waits stay far above the resolution of an Instant.
constexpr double kKickRateMax = 1e9;
/// 1/s; chosen: with the least one, see effects.cpp.
constexpr double kDragMax = 1e12;
/// m/s; chosen: no disk outgrows the range of float before the end of time.
constexpr double kGrowthMax = 1e12;
/// Whole numbers up to here are exact in a double.
constexpr double kWholeMax = 9007199254740992;

/// How the tables reach an effect.
template <auto Effect>
constexpr EffectInfo effect(std::string_view name, std::string_view meaning) {
  return {name,
          meaning,
          [](const Effects& effects) { return (effects.*Effect).has_value(); },
          [](Effects& effects, bool on) {
            (effects.*Effect).reset();
            if (on) (effects.*Effect).emplace();
          }};
}

/// ... and one of its numbers.
template <auto Effect, auto Number>
constexpr EffectParameter number(EffectParameter row) {
  row.read = [](const Effects& effects, int component) {
    const auto& value = (*(effects.*Effect)).*Number;
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Vector2>) {
      return value[component];
    } else {
      static_cast<void>(component);
      return static_cast<double>(value);
    }
  };
  row.write = [](Effects& effects, int component, double given) {
    auto& value = (*(effects.*Effect)).*Number;
    using Type = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Type, Vector2>) {
      value[component] = given;
    } else {
      static_cast<void>(component);
      value = static_cast<Type>(given);
    }
  };
  return row;
}

constexpr std::array kEffects = {
    effect<&Effects::gravity>("gravity", "uniform gravity on dynamic disks"),
    effect<&Effects::drag>("drag", "linear drag on dynamic disks by a medium at rest"),
    effect<&Effects::floor_friction>("floor_friction",
                                     "a constant deceleration of dynamic disks to a stop"),
    effect<&Effects::restitution>("restitution", "contacts that lose energy"),
    effect<&Effects::rough>("rough", "contacts that turn disks"),
    effect<&Effects::growth>("growth", "radii that grow, of disks of all kinds"),
    effect<&Effects::thermostat>("thermostat", "random kicks that hold a temperature"),
};

constexpr std::array kParameters = {
    number<&Effects::gravity, &Gravity::acceleration>({.effect = "gravity",
                                                       .name = "acceleration",
                                                       .unit = "m/s^2",
                                                       .meaning = "of every dynamic disk",
                                                       .low = -kPullMax,
                                                       .high = kPullMax,
                                                       .components = 2}),
    number<&Effects::drag, &Drag::rate>({.effect = "drag",
                                         .name = "rate",
                                         .unit = "1/s",
                                         .meaning = "velocities fall as e^(-rate t); 0: none does",
                                         .high = kDragMax}),
    number<&Effects::floor_friction, &FloorFriction::deceleration>({.effect = "floor_friction",
                                                                    .name = "deceleration",
                                                                    .unit = "m/s^2",
                                                                    .meaning = "while a disk moves",
                                                                    .high = kAnyNumber}),
    number<&Effects::restitution, &Restitution::coefficient>(
        {.effect = "restitution",
         .name = "coefficient",
         .unit = "1",
         .meaning = "normal speed after over before, of two disks",
         .high = 1}),
    number<&Effects::restitution, &Restitution::wall_coefficient>(
        {.effect = "restitution",
         .name = "wall_coefficient",
         .unit = "1",
         .meaning = "of a disk and a wall; by default the same",
         .high = 1,
         .is_required = false}),
    number<&Effects::restitution, &Restitution::contact_duration>(
        {.effect = "restitution",
         .name = "contact_duration",
         .unit = "s",
         .meaning = "a contact sooner after another is elastic; 0: none is",
         .high = kAnyNumber,
         .is_required = false}),
    number<&Effects::restitution, &Restitution::rest_speed>(
        {.effect = "restitution",
         .name = "rest_speed",
         .unit = "m/s",
         .meaning = "under gravity or drag a slower bounce is none; 0: 1e-9",
         .high = kAnyNumber,
         .is_required = false}),
    number<&Effects::rough, &Rough::tangential_restitution>(
        {.effect = "rough",
         .name = "tangential_restitution",
         .unit = "1",
         .meaning = "of surfaces that stick; -1: smooth",
         .low = -1,
         .high = 1}),
    number<&Effects::rough, &Rough::friction>({.effect = "rough",
                                               .name = "friction",
                                               .unit = "1",
                                               .meaning = "tangential over normal impulse, at most",
                                               .high = kAnyNumber}),
    number<&Effects::growth, &Growth::rate>({.effect = "growth",
                                             .name = "rate",
                                             .unit = "m/s",
                                             .meaning = "of every radius",
                                             .high = kGrowthMax}),
    number<&Effects::thermostat, &Thermostat::temperature>({.effect = "thermostat",
                                                            .name = "temperature",
                                                            .unit = "J",
                                                            .meaning = "kT of the bath",
                                                            .high = kTemperatureMax}),
    number<&Effects::thermostat, &Thermostat::rate>({.effect = "thermostat",
                                                     .name = "rate",
                                                     .unit = "1/s",
                                                     .meaning = "kicks of each dynamic disk",
                                                     .high = kKickRateMax}),
    number<&Effects::thermostat, &Thermostat::seed>(
        {.effect = "thermostat",
         .name = "seed",
         .unit = "1",
         .meaning = "of the random numbers; a scene's own seed when it loads",
         .high = kWholeMax,
         .is_required = false,
         .is_whole = true}),
};

constexpr std::array kRefusals = {
    Refusal{"drag", "floor_friction", "together with floor friction has no closed form"},
    Refusal{"floor_friction", "gravity", "together with gravity in the plane has no closed form"},
    Refusal{"rough",
            "gravity",
            "a rough disk that gravity holds on a wall would roll, which has no treatment yet"},
    Refusal{"growth", "gravity", "together with gravity has no exact treatment yet"},
    Refusal{"growth", "drag", "together with drag has no exact treatment yet"},
    Refusal{"growth", "floor_friction", "together with floor friction has no exact treatment yet"},
    Refusal{"growth", "rough", "of rough disks would change their moments of inertia"},
};

std::string full_name(const EffectParameter& parameter, int component) {
  std::string name = std::string(parameter.effect) + "." + std::string(parameter.name);
  if (parameter.components == 2) name += component == 0 ? ".x" : ".y";
  return name;
}

Reject invalid(std::string field, std::string reason) {
  return {.code = Code::InvalidArgument, .field = std::move(field), .reason = std::move(reason)};
}

/// The parameter and component of a full name.
struct Named {
  const EffectParameter* parameter = nullptr;
  int component = 0;
};

Named find(std::string_view name) {
  for (const EffectParameter& parameter : kParameters) {
    for (int component = 0; component < parameter.components; ++component) {
      if (full_name(parameter, component) == name) return {&parameter, component};
    }
  }
  return {};
}

const EffectInfo* find_effect(std::string_view name) {
  const auto* const found = std::find_if(
      kEffects.begin(), kEffects.end(), [&](const EffectInfo& e) { return e.name == name; });
  return found == kEffects.end() ? nullptr : found;
}

/// A required number that nobody has given to an effect that the settings switch on.
std::optional<Reject> check_complete(const EffectInfo& effect,
                                     std::span<const EffectSetting> settings) {
  for (const EffectParameter& parameter : kParameters) {
    if (parameter.effect != effect.name || !parameter.is_required) continue;
    for (int component = 0; component < parameter.components; ++component) {
      const std::string name = full_name(parameter, component);
      const bool is_given = std::any_of(
          settings.begin(), settings.end(), [&](const EffectSetting& s) { return s.name == name; });
      if (!is_given) return invalid(name, "is missing: the effect cannot be switched on without");
    }
  }
  return std::nullopt;
}

bool mentions(std::span<const EffectSetting> settings, std::string_view name) {
  return std::any_of(
      settings.begin(), settings.end(), [&](const EffectSetting& s) { return s.name == name; });
}

}  // namespace

std::span<const EffectInfo> known_effects() { return kEffects; }
std::span<const EffectParameter> effect_parameters() { return kParameters; }
std::span<const Refusal> refused_combinations() { return kRefusals; }

const Refusal* find_refusal(std::string_view effect, std::string_view other) {
  for (const Refusal& refusal : kRefusals) {
    if (refusal.effect == effect && refusal.other == other) return &refusal;
    if (refusal.effect == other && refusal.other == effect) return &refusal;
  }
  return nullptr;
}

std::vector<EffectSetting> settings_of(const Effects& effects) {
  std::vector<EffectSetting> settings;
  for (const EffectParameter& parameter : kParameters) {
    if (!find_effect(parameter.effect)->is_on(effects)) continue;
    for (int component = 0; component < parameter.components; ++component) {
      settings.push_back({full_name(parameter, component), parameter.read(effects, component)});
    }
  }
  return settings;
}

namespace {

bool is_period(std::string_view name) {
  return name == "period" || name == "period.x" || name == "period.y";
}

Reject fixed_period() {
  return {.code = Code::Unimplemented,
          .field = "period",
          .reason =
              "is fixed when a world is made and cannot be switched; make one of a scene "
              "with the period that you want"};
}

}  // namespace

Outcome<Effects> changed_effects(const Effects& present,
                                 std::span<const std::string> off,
                                 std::span<const EffectSetting> settings) {
  Effects effects = present;
  for (const std::string& name : off) {
    const EffectInfo* const effect = find_effect(name);
    if (is_period(name)) return fixed_period();
    if (effect == nullptr) return invalid(name, "is no effect of this version");
    if (!effect->is_on(effects)) return invalid(name, "is not on");
    effect->set(effects, false);
  }
  const Effects before = effects;
  for (const EffectSetting& setting : settings) {
    const Named named = find(setting.name);
    if (is_period(setting.name)) return fixed_period();
    if (named.parameter == nullptr) return invalid(setting.name, "is no number of an effect");
    const EffectInfo& effect = *find_effect(named.parameter->effect);
    const bool is_whole =
        setting.value >= 0 && setting.value <= kWholeMax &&
        static_cast<double>(static_cast<std::uint64_t>(setting.value)) == setting.value;
    if (named.parameter->is_whole && !is_whole) {
      return invalid(setting.name, "must be a whole number in [0, 2^53]");
    }
    if (!effect.is_on(effects)) {
      if (auto reject = check_complete(effect, settings)) return *std::move(reject);
      effect.set(effects, true);
    }
    named.parameter->write(effects, named.component, setting.value);
  }
  const bool is_new = effects.restitution && !before.restitution;
  if (is_new && !mentions(settings, "restitution.wall_coefficient")) {
    effects.restitution->wall_coefficient = effects.restitution->coefficient;
  }
  if (auto reject = check_effects(effects)) return *std::move(reject);
  return effects;
}

}  // namespace stoss::engine
