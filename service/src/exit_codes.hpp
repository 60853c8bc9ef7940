// SPDX-License-Identifier: Apache-2.0
// The exit statuses of stossd, as sysexits.h numbers them.
#pragma once

namespace stoss::service {

inline constexpr int kExitOk = 0;
inline constexpr int kExitUsage = 64;      ///< bad options
inline constexpr int kExitData = 65;       ///< the scene was refused
inline constexpr int kExitInvariant = 70;  ///< a promise of the program itself is broken
inline constexpr int kExitSystem = 71;     ///< the operating system or DDS refused something
inline constexpr int kExitTaken = 75;      ///< another daemon serves a world of this name
inline constexpr int kExitConfig = 78;     ///< options that contradict each other or the machine

}  // namespace stoss::service
