// SPDX-License-Identifier: Apache-2.0
#include "cli/log_file.hpp"

#include <cerrno>
#include <system_error>

namespace stoss::client::cli {

LogFile::LogFile(const std::string& path)
    : path_(path), file_(path == "-" ? stdout : std::fopen(path.c_str(), "wb")) {
  if (!file_) throw std::system_error(errno, std::generic_category(), path);
  buffer_.reserve(kBufferBytes + kBufferBytes / 4);
}

void LogFile::flush() {
  const std::size_t written = std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get());
  if (written != buffer_.size() || std::fflush(file_.get()) != 0) {
    throw std::system_error(errno, std::generic_category(), path_);
  }
  buffer_.clear();
}

}  // namespace stoss::client::cli
