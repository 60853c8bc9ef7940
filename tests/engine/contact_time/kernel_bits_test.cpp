// SPDX-License-Identifier: Apache-2.0
// A trajectory's bits must not depend on the build: the kernels, compiled without optimisation, and
// for a processor with fused multiply-adds, give the numbers of this build.
#include "kernel_bits.hpp"

#include "support/contact_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <vector>

namespace stoss::test {
namespace {

/// Pairs near and far, hits and misses, some near touching, some of them out of all range.
std::vector<KernelInput> inputs() {
  Random random(seed_of_run());
  std::vector<KernelInput> cases(cases_per_family(200000));
  for (KernelInput& c : cases) {
    const double size = random.bits() % 8 == 0 ? random.decades(-200, 200) : 1;
    const double speed = random.bits() % 8 == 0 ? random.decades(-200, 200) : 1;
    const double distance = 1 + random.decades(-17, random.bits() % 2 == 0 ? 1 : 12);
    const double angle = random.uniform(0, 6.28), aim = random.uniform(-1.6, 1.6);
    const double low = random.bits() % 2 == 0 ? 0x1p-54 : 0;
    const auto fill = [&](double(&words)[4], double x, double y) {
      words[0] = x;
      words[1] = x * low * random.uniform(-1, 1);
      words[2] = y;
      words[3] = y * low * random.uniform(-1, 1);
    };
    fill(c.position, size * distance * std::cos(angle), size * distance * std::sin(angle));
    fill(c.velocity,
         -speed * std::cos(angle + aim / distance),
         -speed * std::sin(angle + aim / distance));
    const double edge_x = size * random.uniform(-4, 4);
    fill(c.edge, edge_x, random.bits() % 4 == 0 ? 0 : size);
    c.radius = size / 2;
  }
  return cases;
}

TEST(KernelBits, UnoptimisedBuildAgrees) {
  const std::vector<KernelInput> cases = inputs();
  EXPECT_EQ(stoss_kernel_bits_plain(cases.data(), cases.size()),
            stoss_kernel_bits_here(cases.data(), cases.size()));
}

TEST(KernelBits, BuildWithFusedMultiplyAddAgrees) {
#if defined(STOSS_KERNEL_BITS_FUSED)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    GTEST_SKIP() << "this processor has no fused multiply-add";
  }
  const std::vector<KernelInput> cases = inputs();
  const std::uint64_t fused = stoss_kernel_bits_fused(cases.data(), cases.size());
  std::printf("fingerprint %016llx\n", static_cast<unsigned long long>(fused));
  EXPECT_EQ(fused, stoss_kernel_bits_here(cases.data(), cases.size()));
#else
  GTEST_SKIP() << "x86-64 only";
#endif
}

// The fingerprint of fixed inputs, known beforehand, so that other compilers are held to it too.
// It changes only with the arithmetic of the kernels.
TEST(KernelBits, FingerprintIsTheRecordedOne) {
  const KernelInput cases[] = {
      {{3.1, 0x1p-54, 0.2, -0x1p-58}, {-1, 0x1p-55, 0.1, 0}, {0.3, 0, 4, 0}, 0.7},
      {{1.2, 0, 0.7, 0}, {-1, 0, -0.6, 0}, {1, 0, 1, 0}, 0.69},
      {{1e9, 0, 0.3, 0}, {-7, 0, 0, 0}, {0.1, 0, 3, 0}, 0.5},
      {{1e-170, 0, 3e-170, 0}, {-1e160, 0, -3e160, 0}, {1e-170, 0, 0, 0}, 1e-171}};
  EXPECT_EQ(stoss_kernel_bits_here(cases, std::size(cases)), 3116642306978406415U);
}

}  // namespace
}  // namespace stoss::test
