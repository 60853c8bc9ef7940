// SPDX-License-Identifier: Apache-2.0
// A fingerprint of all kernels over given inputs, to be compiled several times with other flags:
// the same numbers must come out of every build.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stoss::test {

/// Of one case: relative position and velocity, edge, each as (x.hi, x.lo, y.hi, y.lo), and radius.
struct KernelInput {
  double position[4];
  double velocity[4];
  double edge[4];
  double radius;
};

}  // namespace stoss::test

extern "C" {
std::uint64_t stoss_kernel_bits_here(const stoss::test::KernelInput* cases, std::size_t count);
std::uint64_t stoss_kernel_bits_plain(const stoss::test::KernelInput* cases, std::size_t count);
std::uint64_t stoss_kernel_bits_fused(const stoss::test::KernelInput* cases, std::size_t count);
}
