// SPDX-License-Identifier: Apache-2.0
// What each effect costs beside the plain world: processor time per prediction (the kernels, on
// pairs as a gas has them) and per collision (whole worlds of one gas), in one program and in
// turns, so that what else the machine does falls on all.
//
//   effects_bench [--rounds N] [--columns N] [--write FILE]
//
// --write: puts the table between the lines "<!-- cost table -->" and "<!-- end -->" of FILE.

#include "bench/gas_run.hpp"
#include "bench/processor_time.hpp"
#include "laws.hpp"
#include "support/random.hpp"

#include <stoss/engine/world.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace stoss::engine_exact {
bench::Start make_gas_start(int columns, double area_fraction);
}

namespace {

using namespace stoss::engine;
using stoss::bench::Advance;
using stoss::bench::processor_seconds;
using stoss::bench::Start;

constexpr double kPull = 0.05;          // m/s^2: a quarter of the gas's energy over its box
constexpr double kDeceleration = 1e-3;  // m/s^2: the gas moves on through all rounds
constexpr double kDragRate = 1e-3;      // 1/s
constexpr double kGrowthRate = 1e-7;    // m/s: the area fraction stays what it is
constexpr double kAreaFraction = 0.3;

struct Row {
  std::string name;
  Effects effects;
  bool is_other_build = false;  ///< the engine without any effects compiled in
  bool is_periodic = false;     ///< along both axes, about the same box
  int zones = 0;                ///< spread over the box
};

std::vector<Row> make_rows() {
  const auto with = [](const auto& change) {
    Effects effects;
    change(effects);
    return effects;
  };
  const auto lossy = [](Effects& e) { e.restitution = Restitution{0.95, 0.95, 1e-6, 0}; };
  const auto rough = [](Effects& e) { e.rough = Rough{0.9, 0.3}; };
  const auto pull = [](Effects& e) { e.gravity = Gravity{{0, -kPull}}; };
  const auto slowed = [](Effects& e) { e.floor_friction = FloorFriction{kDeceleration}; };
  const auto dragged = [](Effects& e) { e.drag = Drag{kDragRate}; };
  const auto growing = [](Effects& e) { e.growth = Growth{kGrowthRate}; };
  const auto bath = [](Effects& e) { e.thermostat = Thermostat{1, 0.1, 1}; };
  return {
      {"none (the plain world)", {}},
      {"none, in an engine without effects", {}, true},
      {"restitution of 1", with([](Effects& e) { e.restitution = Restitution{}; })},
      {"restitution", with(lossy)},
      {"rough", with(rough)},
      {"restitution, rough", with([&](Effects& e) { lossy(e), rough(e); })},
      {"thermostat", with(bath)},
      {"restitution, thermostat", with([&](Effects& e) { lossy(e), bath(e); })},
      {"gravity", with(pull)},
      {"gravity, restitution", with([&](Effects& e) { pull(e), lossy(e); })},
      {"gravity, restitution, thermostat", with([&](Effects& e) { pull(e), lossy(e), bath(e); })},
      {"drag", with(dragged)},
      {"drag, thermostat", with([&](Effects& e) { dragged(e), bath(e); })},
      {"drag, gravity", with([&](Effects& e) { dragged(e), pull(e); })},
      {"growth", with(growing)},
      {"growth, restitution", with([&](Effects& e) { growing(e), lossy(e); })},
      {"floor friction", with(slowed)},
      {"floor friction, restitution, rough",
       with([&](Effects& e) { slowed(e), lossy(e), rough(e); })},
      {.name = "periodic", .effects = {}, .is_periodic = true},
      {.name = "periodic, gravity", .effects = with(pull), .is_periodic = true},
      {.name = "16 zones", .effects = {}, .zones = 16},
      {.name = "16 zones, floor friction", .effects = with(slowed), .zones = 16},
  };
}

// -- Predictions

constexpr std::size_t kCases = 512;
constexpr std::size_t kKernels = 3;  // two disks; a disk and a wall's face; and its end

/// A disk on its way past another: what a predicted pair looks like.
struct Case {
  DoubleWord2<double> position, velocity, pair_acceleration, wall_acceleration;
};

DoubleWord2<double> words(double x, double y) { return {{x, 0}, {y, 0}}; }

std::vector<Case> make_cases(const Effects& effects) {
  stoss::test::Random random(5);
  std::vector<Case> cases(kCases);
  for (Case& c : cases) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double distance = random.uniform(1, 4);
    c.position = words(distance * std::cos(angle), distance * std::sin(angle));
    c.velocity = words(random.uniform(-2, 2), random.uniform(-2, 2));
    const double one = random.uniform(0, 2 * std::numbers::pi);
    const double two = random.uniform(0, 2 * std::numbers::pi);
    if (effects.gravity) c.wall_acceleration = words(0, -kPull);
    if (effects.floor_friction) {
      c.wall_acceleration = words(kDeceleration * std::cos(one), kDeceleration * std::sin(one));
      c.pair_acceleration = words(kDeceleration * (std::cos(one) - std::cos(two)),
                                  kDeceleration * (std::sin(one) - std::sin(two)));
    }
  }
  return cases;
}

template <class Laws>
typename Laws::template Relative<double> motion_of(
    const Case& c, [[maybe_unused]] const DoubleWord2<double>& acceleration) {
  if constexpr (Laws::kDragged) {
    return {{c.position, c.velocity, acceleration, 0}, kDragRate};
  } else if constexpr (Laws::kCurved) {
    return {c.position, c.velocity, acceleration, 0};
  } else {
    return {c.position, c.velocity, 0};
  }
}

/// A radius of the world's kind.
template <class Laws, class Radius>
Radius radius_of(double radius, double growing) {
  if constexpr (Laws::kGrows) {
    return {{radius, 0}, {growing * kGrowthRate, 0}};
  } else if constexpr (std::is_same_v<Radius, double>) {
    return radius;
  } else {
    return {radius, 0};
  }
}

volatile double sink;  // keeps the results alive

/// ns per call of each kernel.
template <class Laws>
std::array<double, kKernels> time_kernels(const std::vector<Case>& cases) {
  using Reach = typename Laws::template Reach<double>;
  using Radius = std::conditional_t<Laws::kGrows, Reach, double>;
  const auto reach = radius_of<Laws, Reach>(0.875, 2);
  const auto radius = radius_of<Laws, Radius>(0.4375, 1);
  const DoubleWord2<double> edge = words(20, 3);
  const double for_ever = std::numeric_limits<double>::infinity();
  std::array<double, kKernels> result{};
  for (std::size_t kernel = 0; kernel < kKernels; ++kernel) {
    const double begun = processor_seconds();
    double sum = 0;
    for (const Case& c : cases) {
      const auto pair = motion_of<Laws>(c, c.pair_acceleration);
      const auto wall = motion_of<Laws>(c, c.wall_acceleration);
      const auto t = kernel == 0   ? Laws::pair_contact(pair, reach, for_ever)
                     : kernel == 1 ? Laws::face_contact(wall, edge, radius, for_ever)
                                   : Laws::point_contact(wall, radius, for_ever);
      if (t) sum += t->hi;
    }
    sink = sum;
    result[kernel] = 1e9 * (processor_seconds() - begun) / static_cast<double>(cases.size());
  }
  return result;
}

std::array<double, kKernels> time_kernels(const Row& row, const std::vector<Case>& cases) {
  switch (laws_for(row.effects, row.is_periodic || row.zones > 0)) {
    case LawsKind::Plain:
      return time_kernels<PlainLaws>(cases);
    case LawsKind::Contact:
      return time_kernels<ContactLaws>(cases);
    case LawsKind::Growing:
      return time_kernels<GrowingLaws>(cases);
    case LawsKind::Dragged:
      return time_kernels<DragLaws>(cases);
    case LawsKind::Accelerated:
      return time_kernels<AcceleratedLaws>(cases);
  }
  return {};
}

// -- Rounds

/// ns of each column, for each row: the kernels, then a collision.
using Figures = std::array<double, kKernels + 1>;
using Round = std::vector<Figures>;

/// Zones of a tenth of the side, on a lattice; their area is an eighth of the box's.
std::vector<ZoneSpec> make_zones(int count, double side) {
  const auto across = static_cast<int>(std::lround(std::sqrt(count)));
  std::vector<ZoneSpec> zones(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    ZoneSpec& zone = zones[static_cast<std::size_t>(i)];
    zone.center = {side * (i % across + 0.5) / across, side * (i / across + 0.5) / across};
    zone.radius = 0.05 * side;
  }
  return zones;
}

Start make_start(const Row& row, int columns) {
  if (row.is_other_build) return stoss::engine_exact::make_gas_start(columns, kAreaFraction);
  const double side = stoss::bench::side_of_box(columns, kAreaFraction);
  return stoss::bench::make_start<World, DiskSpec, WallSpec>(columns, kAreaFraction, [&] {
    WorldOptions options;
    options.effects = row.effects;
    if (row.is_periodic) options.period = {1.25 * side, 1.25 * side};
    World world(options);
    const std::vector<ZoneSpec> zones = make_zones(row.zones, side);
    if (!world.spawn({.disks = {}, .walls = {}, .zones = zones}).ok()) std::abort();
    return world;
  });
}

std::vector<Round> measure(const std::vector<Row>& rows, int columns, std::size_t rounds) {
  std::vector<Start> starts;
  std::vector<std::vector<Case>> cases;
  for (const Row& row : rows) {
    starts.push_back(make_start(row, columns));
    cases.push_back(make_cases(row.effects));
  }
  const auto events = static_cast<std::uint64_t>(4 * columns * columns);
  std::vector<Round> result(rounds, Round(rows.size()));
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t turn = 0; turn < rows.size(); ++turn) {
      const std::size_t i = (turn + round) % rows.size();  // nobody always comes first
      Figures& figures = result[round][i];
      const auto kernels = time_kernels(rows[i], cases[i]);
      std::copy(kernels.begin(), kernels.end(), figures.begin());
      const Advance advance = starts[i]();
      const double begun = processor_seconds();
      const std::uint64_t collisions = advance(events);
      figures[kKernels] = 1e9 * (processor_seconds() - begun) / static_cast<double>(collisions);
    }
  }
  return result;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string cell(const std::vector<Round>& rounds, std::size_t row, std::size_t column) {
  std::vector<double> times, ratios;
  for (const Round& round : rounds) {
    times.push_back(round[row][column]);
    ratios.push_back(round[row][column] / round[0][column]);
  }
  char text[64];
  std::snprintf(text, sizeof text, "%.0f (%.2f)", median(times), median(ratios));
  return text;
}

std::string table(const std::vector<Row>& rows, const std::vector<Round>& rounds) {
  std::string text =
      "| effects | two disks | disk and wall | disk and wall's end | collision |\n"
      "|---|---|---|---|---|\n";
  for (std::size_t row = 0; row < rows.size(); ++row) {
    text += "| " + rows[row].name + " |";
    for (std::size_t column = 0; column <= kKernels; ++column) {
      const bool is_known = column == kKernels || !rows[row].is_other_build;
      text += ' ' + (is_known ? cell(rounds, row, column) : "") + " |";
    }
    text += '\n';
  }
  return text;
}

/// False when the file has no place for it.
bool write_into(const std::string& path, const std::string& text) {
  constexpr std::string_view kBegin = "<!-- cost table -->\n";
  constexpr std::string_view kEnd = "<!-- end -->";
  std::ostringstream all;
  all << std::ifstream(path).rdbuf();
  std::string page = all.str();
  const std::size_t begin = page.find(kBegin);
  const std::size_t end = page.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) return false;
  page.replace(begin + kBegin.size(), end - begin - kBegin.size(), text);
  return static_cast<bool>(std::ofstream(path) << page);
}

}  // namespace

int main(int argc, char** argv) {
  int rounds = 21;
  int columns = 32;
  std::string file;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--rounds") == 0) rounds = std::max(1, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--columns") == 0) columns = std::max(4, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--write") == 0) file = argv[i + 1];
  }
  const std::vector<Row> rows = make_rows();
  const std::string text = table(rows, measure(rows, columns, static_cast<std::size_t>(rounds)));
  std::printf("ns (ratio to the plain world), medians of %d rounds, %d disks\n%s",
              rounds,
              columns * columns,
              text.c_str());
  if (file.empty() || write_into(file, text)) return 0;
  std::fprintf(stderr, "%s: no place for the table\n", file.c_str());
  return 1;
}
