// SPDX-License-Identifier: Apache-2.0
#include <stoss/dds/qos.hpp>

namespace stoss::dds {
namespace {

dds_qos_t* made(dds_qos_t* qos) {
  if (qos == nullptr) throw Error("create QoS", DDS_RETCODE_OUT_OF_RESOURCES);
  return qos;
}

}  // namespace

Qos::Qos() : qos_(made(dds_create_qos())) {}

Qos::Qos(const Qos& other) : Qos() { check(dds_copy_qos(qos_.get(), other.raw()), "copy QoS"); }

Qos& Qos::operator=(const Qos& other) {
  if (this != &other) *this = Qos(other);
  return *this;
}

Qos& Qos::reliable(std::chrono::nanoseconds max_block) {
  dds_qset_reliability(qos_.get(), DDS_RELIABILITY_RELIABLE, max_block.count());
  return *this;
}

Qos& Qos::best_effort() {
  dds_qset_reliability(qos_.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  return *this;
}

Qos& Qos::keep_last(std::int32_t depth) {
  dds_qset_history(qos_.get(), DDS_HISTORY_KEEP_LAST, depth);
  return *this;
}

Qos& Qos::keep_all() {
  dds_qset_history(qos_.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  return *this;
}

Qos& Qos::volatile_durability() {
  dds_qset_durability(qos_.get(), DDS_DURABILITY_VOLATILE);
  return *this;
}

Qos& Qos::transient_local(std::int32_t depth) {
  dds_qset_durability(qos_.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  // What late joiners get is set apart from what lagging readers get.
  dds_qset_durability_service(qos_.get(),
                              0,
                              DDS_HISTORY_KEEP_LAST,
                              depth,
                              DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED);
  return *this;
}

Qos& Qos::partition(const std::string& name) {
  dds_qset_partition1(qos_.get(), name.c_str());
  return *this;
}

Qos& Qos::autodispose(bool on) {
  dds_qset_writer_data_lifecycle(qos_.get(), on);
  return *this;
}

bool operator==(const Qos& a, const Qos& b) { return dds_qos_equal(a.raw(), b.raw()); }

}  // namespace stoss::dds
