// SPDX-License-Identifier: Apache-2.0
#include <stoss/idl/sequence.hpp>
#include <stoss/translate/query.hpp>

namespace stoss::translate {

engine::Outcome<QuerySpec> query_of(const wire::Query& query) {
  if (query.protocol != idl::kProtocol) return unknown_protocol(query.protocol);
  QuerySpec spec;
  spec.request = to_engine(query.request);
  spec.op = query.op;
  if (query.timed) spec.at = to_engine(query.at);
  const auto ids = idl::view(query.ids);
  spec.ids.assign(ids.begin(), ids.end());
  spec.low = {query.min_x, query.min_y};
  spec.high = {query.max_x, query.max_y};
  spec.point = {query.x, query.y};
  spec.direction = {query.direction_x, query.direction_y};
  spec.distance = query.distance;
  spec.number = query.number;
  spec.count = query.count;
  return spec;
}

}  // namespace stoss::translate
