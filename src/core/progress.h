#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace photopic {

/// A progress line on stderr: percentage, samples/s and time left; redrawn in place on a terminal, a plain
/// line every few seconds when piped, nothing when quiet. Any thread may advance it.
class Progress {
 public:
  /// @param label what is under way; @param total units of work, 0: not known; @param unit "samples"; empty:
  /// no rate is shown; @param seconds that the work ends after at the latest, 0: no limit
  Progress(std::string label, std::uint64_t total, std::string unit, bool quiet, double seconds = 0.0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::uint64_t units);

 private:
  void print(std::uint64_t done, bool last);
  double share(std::uint64_t done, double elapsed) const;

  const std::string label_, unit_;
  const std::uint64_t total_;
  const bool quiet_, terminal_;
  const double seconds_;
  const std::chrono::steady_clock::time_point start_;
  std::atomic<std::uint64_t> done_{0};
  std::mutex mutex_;
  std::chrono::steady_clock::time_point next_print_;
};

}  // namespace photopic
