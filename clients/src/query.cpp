// SPDX-License-Identifier: Apache-2.0
#include <stoss/client/query.hpp>

#include <utility>

namespace stoss::client {

Query Query::states(std::vector<engine::Id> ids) {
  Query query;
  query.op = idl::Ask::kStates;
  query.ids = std::move(ids);
  return query;
}

Query Query::list() {
  Query query;
  query.op = idl::Ask::kList;
  return query;
}

Query Query::region(const engine::Vector2& low, const engine::Vector2& high) {
  Query query;
  query.op = idl::Ask::kRegion;
  query.low = low;
  query.high = high;
  return query;
}

Query Query::nearest(const engine::Vector2& point, std::uint64_t count) {
  Query query;
  query.op = idl::Ask::kNearest;
  query.point = point;
  query.count = count;
  return query;
}

Query Query::ray(const engine::Vector2& origin,
                 const engine::Vector2& direction,
                 double length,
                 std::uint64_t count) {
  Query query;
  query.op = idl::Ask::kRay;
  query.point = origin;
  query.direction = direction;
  query.distance = length;
  query.count = count;
  return query;
}

Query Query::world() {
  Query query;
  query.op = idl::Ask::kWorld;
  return query;
}

Query Query::collisions(std::uint64_t first, std::uint64_t count) {
  Query query;
  query.op = idl::Ask::kCollisions;
  query.number = first;
  query.count = count;
  return query;
}

Query Query::zone_events(std::uint64_t first, std::uint64_t count) {
  Query query;
  query.op = idl::Ask::kZoneEvents;
  query.number = first;
  query.count = count;
  return query;
}

Query Query::features() {
  Query query;
  query.op = idl::Ask::kFeatures;
  return query;
}

Query Query::status() {
  Query query;
  query.op = idl::Ask::kStatus;
  return query;
}

Query& Query::at(const engine::Instant& when) {
  instant = when;
  return *this;
}

}  // namespace stoss::client
