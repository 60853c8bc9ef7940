// SPDX-License-Identifier: Apache-2.0
#include "accuracy/measure.hpp"

#include "accuracy/cpu_clock.hpp"
#include "accuracy/horizons.hpp"
#include "accuracy/story.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace stoss::client::accuracy {
namespace {

// Parts of the budget.
constexpr double kProbePart = 0.01;
constexpr double kHorizonPart = 0.06;    ///< for each arithmetic
constexpr double kReferencePart = 0.12;  ///< for one run of the reference; no arithmetic is slower
constexpr double kOthersMin = 0.3;       ///< for the stepped methods, if no more is left
constexpr double kObservedFactor = 4;    ///< being looked at may take so much longer
constexpr double kRepeatPart = 0.005;    ///< runs as short as this are timed three times
constexpr int kRepeats = 3;

// A run may be late by two steps at its end without being held to be wrong; parts of the run.
constexpr double kSlackMin = 1e-3;
constexpr double kSlackMax = 0.125;

/// The largest number of two digits that is not above x.
double rounded_down(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::floor(x / unit * (1 + 1e-12)) * unit;
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

struct Timed {
  double cpu_s = 0;
  double reached_s = 0;
  std::string failure;
};

class Measurement {
 public:
  Measurement(const std::string& scene,
              const translate::SceneBodies& bodies,
              const Options& options)
      : bodies_(bodies), options_(options) {
    report_.scene = scene;
    for (const engine::DiskSpec& disk : bodies.disks) {
      report_.disks += disk.kind == engine::BodyKind::Dynamic ? 1U : 0U;
      if (disk.kind == engine::BodyKind::Kinematic && disk.velocity.norm() > 0) {
        report_.conserves_energy = false;
      }
    }
    for (const engine::WallSpec& wall : bodies.walls) {
      if (wall.velocity.norm() > 0) report_.conserves_energy = false;
    }
  }

  Report take() {
    for (Method& method : exact_methods(bodies_)) add(std::move(method));
    reference_ = report_.methods.size() - 1;
    for (std::size_t i = 0; i < reference_; ++i) {
      if (report_.methods[i].method.arithmetic == engine::Arithmetic::Double) double_ = i;
    }
    report_.reference = report_.methods[reference_].method.name;
    find_horizons();
    choose_end();
    for (Method& method : stepped_methods(bodies_, steps(), options_.substeps)) {
      add(std::move(method));
    }
    for (const Method& method : options_.others) add(method);
    observe_reference();
    for (std::size_t i = 0; i < reference_; ++i) observe(report_.methods[i]);
    others_s_ = std::max(options_.budget_s - clock_.seconds(), kOthersMin * options_.budget_s);
    for (std::size_t i = reference_ + 1; i < report_.methods.size(); ++i) {
      observe(report_.methods[i]);
    }
    time_all();
    return std::move(report_);
  }

 private:
  void add(Method method) {
    Figures figures;
    figures.method = std::move(method);
    report_.methods.push_back(std::move(figures));
  }

  [[nodiscard]] std::vector<double> steps() const {
    return options_.steps.empty() ? default_steps(bodies_, report_.until_s) : options_.steps;
  }

  [[nodiscard]] engine::Instant after_start(double seconds) const {
    const auto instant = engine::offset_by(bodies_.start, seconds);
    if (!instant) throw std::runtime_error("the run would go beyond the end of time");
    return *instant;
  }

  [[nodiscard]] double since_start(const engine::Instant& instant) const {
    return engine::seconds_between(bodies_.start, instant);
  }

  [[nodiscard]] double sample_s(std::uint32_t k) const {
    return report_.until_s * k / options_.samples;
  }

  void find_horizons() {
    for (Figures& figures : report_.methods) {
      try {
        figures.horizon =
            horizon_of(figures.method, bodies_, report_.disks, kHorizonPart * options_.budget_s);
      } catch (const std::runtime_error& error) {
        figures.failure = error.what();
      }
    }
  }

  /// The duration asked for; else double's horizon; else where the collisions end.
  [[nodiscard]] double wanted_end() {
    if (options_.until) return engine::seconds_between({}, *options_.until);
    constexpr double kQuietPart = 1.25;
    const Figures& figures = report_.methods[double_];
    if (figures.horizon && std::isfinite(figures.horizon->time_s) && figures.horizon->time_s > 0) {
      report_.notes.push_back(
          figures.horizon->at_least
              ? "no --until: as far as the search for the horizon of double went"
              : "no --until: up to the horizon of double");
      return rounded_down(figures.horizon->time_s);
    }
    const Probe begin = probe(figures.method, bodies_.start, kProbePart * options_.budget_s);
    if (begin.collisions == 0) {
      report_.notes.emplace_back("no --until, and nothing ever collides: one second");
      return 1;
    }
    report_.notes.emplace_back("no --until: up to a little after the last collision");
    return rounded_down(std::max(begin.reached_s, 1e-300) * kQuietPart);
  }

  /// Runs the reference for its time, which tells how far everything can be compared.
  void choose_end() {
    report_.until_s = wanted_end();
    Figures& reference = report_.methods[reference_];
    const Timed timed = run_for_time(reference.method, kReferencePart * options_.budget_s);
    if (!timed.failure.empty()) {
      throw std::runtime_error("the reference (" + report_.reference + "): " + timed.failure);
    }
    keep_best(reference, timed);
    if (timed.reached_s >= report_.until_s) return;
    if (!(timed.reached_s > 0)) {
      throw std::runtime_error("the reference (" + report_.reference +
                               ") gets nowhere within its part of --budget; give more");
    }
    const double reached = rounded_down(timed.reached_s);
    report_.notes.push_back("the reference (" + report_.reference + ") came to " +
                            text_of(reached) + " s of " + text_of(report_.until_s) +
                            " s within its part of --budget; all is compared up to there");
    report_.until_s = reached;
  }

  [[nodiscard]] Timed run_for_time(const Method& method, double cpu_max) const {
    Timed timed;
    try {
      const auto run = method.start(false);
      const engine::Instant end = after_start(report_.until_s);
      const CpuClock clock;
      bool arrived = false;
      while (!arrived && clock.seconds() < cpu_max) {
        arrived = run->advance(end, nullptr, method.work);
      }
      timed.cpu_s = clock.seconds();
      timed.reached_s = arrived ? report_.until_s : since_start(run->now());
    } catch (const std::runtime_error& error) {
      timed.failure = error.what();
    }
    return timed;
  }

  static void keep_best(Figures& figures, const Timed& timed) {
    if (!timed.failure.empty()) {
      figures.failure = timed.failure;
      return;
    }
    if (!(timed.reached_s > 0)) return;
    const double cost = timed.cpu_s / timed.reached_s;
    if (!(figures.cpu_s_per_s <= cost)) figures.cpu_s_per_s = cost;
  }

  void observe_reference() {
    Figures& figures = report_.methods[reference_];
    look_at(figures, reference_story_, reference_snapshots_, options_.budget_s);
    if (!figures.failure.empty()) throw std::runtime_error(figures.failure);
    figures.right_collisions = reference_story_.count();
    figures.right_collisions_per_disk = per_disk(reference_story_.pairs());
  }

  void observe(Figures& figures) {
    if (!figures.failure.empty()) return;
    Story story;
    std::vector<Snapshot> snapshots;
    look_at(figures, story, snapshots, observed_max(figures));
    const double slack = std::clamp(
        2 * figures.method.step, report_.until_s * kSlackMin, report_.until_s * kSlackMax);
    const Agreement agreement =
        compare(reference_story_, story, after_start(std::max(0.0, figures.reached_s - slack)));
    if (agreement.first_wrong) figures.first_wrong_s = since_start(*agreement.first_wrong);
    figures.right_collisions = agreement.collisions;
    figures.right_collisions_per_disk = per_disk(agreement.pairs);
  }

  [[nodiscard]] double per_disk(std::uint64_t pairs) const {
    return 2 * static_cast<double>(pairs) / static_cast<double>(report_.disks);
  }

  [[nodiscard]] double timed_max(const Figures& figures) const {
    if (figures.method.arithmetic) return kReferencePart * options_.budget_s;
    const auto others = static_cast<double>(report_.methods.size() - reference_ - 1);
    return others_s_ / (others * (1 + kObservedFactor));
  }
  [[nodiscard]] double observed_max(const Figures& figures) const {
    return timed_max(figures) * kObservedFactor;
  }

  /// The run that is looked at: states at every sample, the story, faults.
  void look_at(Figures& figures, Story& story, std::vector<Snapshot>& snapshots, double cpu_max) {
    try {
      const auto run = figures.method.start(true);
      const engine::DoubleWord<double> energy = run->snapshot(bodies_.start).energy;
      const CpuClock clock;
      for (std::uint32_t k = 1; k <= options_.samples; ++k) {
        const engine::Instant instant = after_start(sample_s(k));
        bool arrived = false;
        while (!arrived && clock.seconds() < cpu_max) {
          arrived = run->advance(instant, &story, figures.method.work);
        }
        if (!arrived) break;
        snapshots.push_back(run->snapshot(instant));
        figures.points.push_back(point_at(k, snapshots.back(), energy, figures));
        figures.points.back().collisions = story.count();
        figures.reached_s = sample_s(k);
        figures.faults = run->faults();
      }
    } catch (const std::runtime_error& error) {
      figures.failure = error.what();
    }
    figures.collisions = story.count();
  }

  [[nodiscard]] Point point_at(std::uint32_t k,
                               const Snapshot& snapshot,
                               const engine::DoubleWord<double>& start_energy,
                               const Figures& figures) const {
    Point point{.time_s = sample_s(k)};
    const bool is_reference = &figures == &report_.methods[reference_];
    const bool has_truth = !is_reference && k <= reference_snapshots_.size();
    const Snapshot* truth = has_truth ? &reference_snapshots_[k - 1] : nullptr;
    if (report_.conserves_energy) {
      point.energy_error = relative(snapshot.energy, start_energy);
    } else if (truth != nullptr) {
      point.energy_error = relative(snapshot.energy, truth->energy);
    }
    const auto& horizon = report_.methods[reference_].horizon;
    const bool beyond = horizon && !horizon->at_least && point.time_s > horizon->time_s;
    if (truth == nullptr || beyond) return point;
    double sum = 0;
    double largest = 0;
    for (std::size_t i = 0; i < truth->positions.size(); ++i) {
      const auto offset = snapshot.positions[i] - truth->positions[i];
      const double distance2 = offset.x.hi * offset.x.hi + offset.y.hi * offset.y.hi;
      sum += distance2;
      largest = std::max(largest, distance2);
    }
    point.position_error_rms_m = std::sqrt(sum / static_cast<double>(truth->positions.size()));
    point.position_error_max_m = std::sqrt(largest);
    return point;
  }

  static double relative(const engine::DoubleWord<double>& value,
                         const engine::DoubleWord<double>& truth) {
    const double difference = std::abs((value - truth).hi);
    if (difference == 0) return 0;
    return truth.hi > 0 ? difference / truth.hi : kUnknown;
  }

  /// In turns, so that whatever else the machine does falls on all alike; the best counts.
  void time_all() {
    for (int round = 0; round < kRepeats; ++round) {
      for (Figures& figures : report_.methods) {
        const double known = figures.cpu_s_per_s * report_.until_s;
        if (!figures.failure.empty() || known > kRepeatPart * options_.budget_s) continue;
        keep_best(figures, run_for_time(figures.method, timed_max(figures)));
      }
    }
    const double unit = report_.methods[double_].cpu_s_per_s;
    for (Figures& figures : report_.methods) {
      figures.cpu_ratio = figures.cpu_s_per_s / unit;
      if (figures.collisions > 0) {
        figures.cpu_s_per_collision =
            figures.cpu_s_per_s * figures.reached_s / static_cast<double>(figures.collisions);
      }
    }
  }

  const translate::SceneBodies& bodies_;
  const Options& options_;
  const CpuClock clock_;
  double others_s_ = 0;  ///< CPU time that is left for the stepped methods
  Report report_;
  std::size_t reference_ = 0;
  std::size_t double_ = 0;
  Story reference_story_;
  std::vector<Snapshot> reference_snapshots_;
};

}  // namespace

Report measure(const std::string& scene,
               const translate::SceneBodies& bodies,
               const Options& options) {
  return Measurement(scene, bodies, options).take();
}

}  // namespace stoss::client::accuracy
