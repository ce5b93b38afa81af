#include "core/progress.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

namespace photopic {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr milliseconds kTerminalInterval{200};
constexpr seconds kPipeInterval{5};

std::string format_seconds(double s) {
  const auto whole = static_cast<std::uint64_t>(s + 0.5);
  if (whole < 60) return fmt::format("{:.1f} s", s);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

std::string format_rate(double per_second, const std::string& unit) {
  if (per_second >= 1e6) return fmt::format("{:.2f} M {}/s", per_second * 1e-6, unit);
  if (per_second >= 1e3) return fmt::format("{:.1f} k {}/s", per_second * 1e-3, unit);
  return fmt::format("{:.1f} {}/s", per_second, unit);
}

}  // namespace

Progress::Progress(std::string label, std::uint64_t total, std::string unit, bool quiet, double seconds)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      seconds_(seconds),
      start_(steady_clock::now()),
      next_print_(start_ + (terminal_ ? steady_clock::duration(kTerminalInterval) : kPipeInterval)) {}

Progress::~Progress() {
  if (!quiet_) print(done_.load(), true);
}

void Progress::advance(std::uint64_t units) {
  const std::uint64_t done = done_.fetch_add(units, std::memory_order_relaxed) + units;
  if (quiet_) return;
  // Whoever finds another thread printing goes on with its work.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  const auto now = steady_clock::now();
  if (now < next_print_) return;
  next_print_ = now + (terminal_ ? steady_clock::duration(kTerminalInterval) : kPipeInterval);
  print(done, false);
}

/// By the work or the clock, whichever is further.
double Progress::share(std::uint64_t done, double elapsed) const {
  const double work = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 0.0;
  const double time = seconds_ > 0.0 ? elapsed / seconds_ : 0.0;
  return std::min(std::max(work, time), 1.0);
}

void Progress::print(std::uint64_t done, bool last) {
  const double elapsed = duration<double>(steady_clock::now() - start_).count();
  const double part = share(done, elapsed);
  std::vector<std::string> facts;
  if (part > 0 || total_ > 0) facts.push_back(fmt::format("{:3.0f} %", 100.0 * part));
  if (!unit_.empty() && elapsed > 0) facts.push_back(format_rate(static_cast<double>(done) / elapsed, unit_));
  if (last)
    facts.push_back("took " + format_seconds(elapsed));
  else if (part > 0)
    facts.push_back(format_seconds(elapsed * (1.0 / part - 1.0)) + " left");
  const std::string line = fmt::format("{}: {}", label_, fmt::join(facts, ", "));
  // On a terminal the line is drawn over the one before; \033[K clears what that one had more.
  const std::string drawn = fmt::format("{}{}{}{}", terminal_ ? "\r" : "", line, terminal_ ? "\033[K" : "",
                                        !terminal_ || last ? "\n" : "");
  std::fputs(drawn.c_str(),
             stderr);  // fmt::print would throw, and end the render, where stderr takes nothing
  std::fflush(stderr);
}

}  // namespace photopic
