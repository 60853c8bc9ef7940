// SPDX-License-Identifier: Apache-2.0
// Names of threads, for people who look at a running daemon.
#pragma once

#include <pthread.h>

namespace stoss::service {

/// Names the calling thread; at most 15 characters are kept by the kernel.
inline void name_thread(const char* name) {
  static_cast<void>(pthread_setname_np(pthread_self(), name));
}

}  // namespace stoss::service
