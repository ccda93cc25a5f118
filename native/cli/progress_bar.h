#pragma once

#include <chrono>
#include <string>

namespace isostar::native {

/// A bar on standard error while work takes more than a second; silent in a pipe, gone when the
/// work is done.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(double done);  // 0 … 1

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  Clock::time_point next_;
  bool terminal_, drawn_ = false;
};

}  // namespace isostar::native
