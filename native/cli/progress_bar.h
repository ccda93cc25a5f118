#pragma once

#include <chrono>
#include <string>

namespace isostar::native {

/// A progress bar on standard error for work of more than a second. It is shown only on a terminal
/// and removed by the destructor.
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
