// SPDX-License-Identifier: Apache-2.0
// A topic and the compile-time link from a generated type to its descriptor.
#pragma once

#include <stoss/dds/participant.hpp>

#include <string>

namespace stoss::dds {

/// Specialised once per generated type T: `static const dds_topic_descriptor_t& descriptor()`.
template <class T>
struct TopicType;

/// A topic of type T. Must outlive its readers and writers.
template <class T>
class Topic : public Entity {
 public:
  Topic(const Participant& participant, const std::string& name)
      : Entity(
            dds_create_topic(
                participant.handle(), &TopicType<T>::descriptor(), name.c_str(), nullptr, nullptr),
            "create topic " + name) {}
};

}  // namespace stoss::dds
