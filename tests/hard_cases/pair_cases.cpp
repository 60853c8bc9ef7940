// SPDX-License-Identifier: Apache-2.0
// Two disks.

#include "contact_time/disk_disk.hpp"
#include "hard_cases/case.hpp"

#include <cmath>

namespace stoss::hard_cases {

namespace {

using engine::DiskSpec;
using engine::Instant;
using engine::Vector2;
using engine::World;

DiskSpec disk_of(const Case& c, const char* number) {
  const auto key = [&](const char* letter) { return std::string(letter) + number; };
  DiskSpec spec = test::disk(static_cast<engine::Id>(*number - '0'),
                             c.vector(key("p").c_str()),
                             c.vector(key("v").c_str()),
                             c.number(key("r").c_str()));
  if (!c.has(key("m").c_str())) return spec;
  const double mass = c.number(key("m").c_str());
  if (std::isinf(mass)) {
    spec.kind = engine::BodyKind::Kinematic;
  } else {
    spec.mass = mass;
  }
  return spec;
}

/// The kernel's answer, for times that an Instant cannot hold.
void expect_kernel_time(const Case& c, const DiskSpec& a, const DiskSpec& b) {
  const auto words = [](const Vector2& to, const Vector2& from) {
    return engine::DoubleWord2<double>{engine::two_sum(to.x(), -from.x()),
                                       engine::two_sum(to.y(), -from.y())};
  };
  const engine::RelativeMotion<double> motion{words(b.position, a.position),
                                              words(b.velocity, a.velocity)};
  const auto t = engine::disk_disk_contact(motion, engine::two_sum(a.radius, b.radius));
  ASSERT_EQ(t.has_value(), c.expected().at("event").get<bool>());
  if (!t) return;
  const Real truth = Case::real(c.expected().at("t"));
  const Real allowed = truth * Real(c.tolerance("t_rel", 0)) + Real(c.tolerance("t_abs", 0));
  EXPECT_LE(abs(test::exact(*t) - truth), allowed);
}

}  // namespace

std::string run_pair(const Case& c) {
  const DiskSpec a = disk_of(c, "1");
  const DiskSpec b = disk_of(c, "2");
  expect_kernel_time(c, a, b);

  World world = world_of(c);
  test::must_spawn(world, {a, b});
  test::Log log;
  const Instant end{engine::kSecondsMax - 1, 0};
  EXPECT_EQ(world.advance_to(end, &log, 10'000).value().stop, engine::Stop::Reached);
  const bool too_late = c.expected().at("event").get<bool>() &&
                        Case::real(c.expected().at("t")) > Real(engine::kSecondsMax);
  const bool event = c.expected().at("event").get<bool>() && !too_late;
  EXPECT_EQ(log.collisions.size(), event ? 1U : 0U);
  if (too_late) return "through the kernel; the contact is beyond the end of a world's time";
  if (!event || log.collisions.empty()) return "";

  expect_time(c, {}, log.collisions[0].instant);
  const Real2 normal = Case::real2(c.expected().at("normal_1_to_2"));
  const Vector2& found = log.collisions[0].normal;
  const Real off = norm({Real(found.x()) - normal.x, Real(found.y()) - normal.y});
  EXPECT_LE(off, Real(c.tolerance("v_rel_from_relative_contact_vector", 4e-15)));

  const double scale = std::max(a.velocity.norm(), b.velocity.norm());
  // The better tolerance of the two: contact vectors are relative here.
  const double strict = c.tolerance("v_rel_from_relative_contact_vector", c.tolerance("v_rel", 0));
  for (const engine::Id id : {1U, 2U}) {
    const char* key = id == 1 ? "v1_after" : "v2_after";
    const Real2 truth = Case::real2(c.expected().at(key));
    const Real2 value = velocity_of(world, id);
    expect_vector(c, value, truth, scale);
    if (strict > 0) {
      EXPECT_LE(norm({value.x - truth.x, value.y - truth.y}), Real(strict) * Real(scale));
    }
  }
  return "";
}

std::string run_epoch_pair(const Case& c) {
  const auto start = static_cast<std::int64_t>(c.number("t_start"));
  World world = world_of(c, {start, 0});
  test::must_spawn(world, {disk_of(c, "1"), disk_of(c, "2")});
  const auto log = test::run_for(world, 100);
  EXPECT_EQ(log.size(), 1U);
  if (log.empty()) return "";
  const Real truth = Case::real(c.expected().at("offset_from_start"));
  const Real offset = seconds_from({start, 0}, log[0].instant);
  EXPECT_LE(abs(offset - truth), truth * Real(c.tolerance("offset_rel", 0)));
  const Real absolute = offset + Real(start);
  EXPECT_LE(abs(absolute - Case::real(c.expected().at("absolute_time"))), Real(1e-14));
  return "";
}

}  // namespace stoss::hard_cases
