// SPDX-License-Identifier: Apache-2.0
// The whole RAII face of DDS. Raw handles live behind these types and nowhere else.
#pragma once

#include <stoss/dds/config.hpp>
#include <stoss/dds/entity.hpp>
#include <stoss/dds/error.hpp>
#include <stoss/dds/log.hpp>
#include <stoss/dds/loopback_guard.hpp>
#include <stoss/dds/participant.hpp>
#include <stoss/dds/qos.hpp>
#include <stoss/dds/reader.hpp>
#include <stoss/dds/topic.hpp>
#include <stoss/dds/waitset.hpp>
#include <stoss/dds/writer.hpp>
