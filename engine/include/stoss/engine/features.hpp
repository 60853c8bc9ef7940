// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the engine can do, as data: every effect with its numbers and their ranges, and which
// effects do not go together. check_effects() follows these tables, and programs print them.

#include <stoss/engine/effects.hpp>
#include <stoss/engine/outcome.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stoss::engine {

/// One number of an effect, or both components of a vector.
struct EffectParameter {
  std::string_view effect;  ///< as a scene spells it: "gravity"
  std::string_view name;    ///< "acceleration"
  std::string_view unit;    ///< "1": a pure number
  std::string_view meaning;
  double low = 0;  ///< the least value, and the largest; a vector's components may be +- `high`
  double high = 0;
  int components = 1;
  bool is_required = true;  ///< whoever switches the effect on must give it
  bool is_whole = false;
  double (*read)(const Effects& effects, int component) = nullptr;  ///< REQUIRES: the effect is on
  void (*write)(Effects& effects, int component, double value) = nullptr;  ///< REQUIRES: likewise
};

struct EffectInfo {
  std::string_view name;
  std::string_view meaning;
  bool (*is_on)(const Effects& effects) = nullptr;
  void (*set)(Effects& effects, bool on) = nullptr;  ///< on: with every number at its default
};

/// Two effects that a world cannot have together, and why.
struct Refusal {
  std::string_view effect;  ///< the one that the refusal names
  std::string_view other;
  std::string_view reason;
};

/// In the order in which they are checked and printed.
[[nodiscard]] std::span<const EffectInfo> known_effects();
[[nodiscard]] std::span<const EffectParameter> effect_parameters();
/// Every pair that is not here works exactly.
[[nodiscard]] std::span<const Refusal> refused_combinations();
/// Nothing if the two go together.
[[nodiscard]] const Refusal* find_refusal(std::string_view effect, std::string_view other);

/// A number of an effect by its name, as "restitution.coefficient" or "gravity.acceleration.x".
struct EffectSetting {
  std::string name;
  double value = 0;
};

/// The numbers of the effects that are on.
[[nodiscard]] std::vector<EffectSetting> settings_of(const Effects& effects);

/// The effects after some are switched off and then numbers are set. A number of an effect that is
/// off switches it on, and its other numbers have their defaults. Errors: InvalidArgument for a
/// name that is none, an effect to switch off that is not on, a required number that is missing;
/// and those of check_effects().
[[nodiscard]] Outcome<Effects> changed_effects(const Effects& present,
                                               std::span<const std::string> off,
                                               std::span<const EffectSetting> settings);

}  // namespace stoss::engine
