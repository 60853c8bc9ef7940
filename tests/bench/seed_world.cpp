// SPDX-License-Identifier: Apache-2.0
// The engine in double, compiled anew from its own sources: with its own kernels, or with those of
// seed_engine.hpp where STOSS_SEED_KERNELS asks for them. The build renames the namespace `engine`,
// so that all of them fit into one program.
#ifdef STOSS_SEED_KERNELS
#include "bench/seed_engine.hpp"
#endif

#include "basic_world.hpp"
#include "bench/gas_run.hpp"

#include <stdexcept>

namespace stoss::engine {

template <>
std::unique_ptr<WorldCore> make_plain_core<double>(const WorldOptions& options) {
  return std::make_unique<BasicWorld<double, PlainLaws>>(options);
}

template <>
std::unique_ptr<WorldCore> make_effects_core<double>(const WorldOptions&) {
  throw std::logic_error("this program's worlds are plain");
}

std::unique_ptr<WorldCore> make_core(const WorldOptions& options) {
  return make_core_in<double>(options);
}

bench::Advance make_gas_run(int columns, double area_fraction) {
  return bench::make_run<World, DiskSpec, WallSpec>(columns, area_fraction);
}

bench::Start make_gas_start(int columns, double area_fraction) {
  return bench::make_start<World, DiskSpec, WallSpec>(columns, area_fraction);
}

}  // namespace stoss::engine
