// SPDX-License-Identifier: Apache-2.0
#pragma once

// Buffered output of lines to a file or to standard output.

#include <cstdio>
#include <memory>
#include <string>

namespace stoss::client::cli {

/// Where JSON Lines go. Writes in large pieces; says at the end whether all of it arrived.
class LogFile {
 public:
  /// "-" is standard output. Throws std::system_error when the file cannot be made.
  explicit LogFile(const std::string& path);

  /// The buffer to append whole lines to; call flush_if_full() now and then.
  [[nodiscard]] std::string& buffer() { return buffer_; }
  void flush_if_full() {
    if (buffer_.size() >= kBufferBytes) flush();
  }
  /// Throws std::system_error when the output does not take it (a full disk).
  void flush();

 private:
  static constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

  struct Closer {
    void operator()(std::FILE* file) const {
      if (file != stdout) std::fclose(file);
    }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::string buffer_;
};

}  // namespace stoss::client::cli
