/// Prints the whole stress table: stress_table [--brief] [TOPIC…]; exit code 1 when a case fails.

#include <algorithm>
#include <cstdio>
#include <string>

#include "stress_case.h"

namespace {

using namespace photopic;
using namespace photopic::test;

std::string causes(const RenderStats& stats) {
  std::string text = std::to_string(stats.non_finite);
  for (std::size_t i = 0; i < kNonFiniteCauses; ++i)
    if (stats.non_finite_causes.of[i] > 0)
      text +=
          " " + std::string(kNonFiniteCauseNames[i]) + " " + std::to_string(stats.non_finite_causes.of[i]);
  return text;
}

/// Pads by characters, not bytes: names may hold a degree sign.
std::string padded(const std::string& text, std::size_t width) {
  const auto characters = static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
  return text + std::string(width - std::min(width, characters), ' ');
}

void print_row(const StressCase& c, const Outcome& o) {
  const std::string leaks = o.leaks ? std::to_string(*o.leaks) : "-";
  std::printf("%s %s %s %12.7g ± %-8.2g %6.2f %6s  %-10s %s\n", padded(c.topic, 15).c_str(),
              padded(c.name, 66).c_str(), padded(o.expected, 22).c_str(), o.measured.mean, o.measured.error,
              o.z, leaks.c_str(), causes(o.stats).c_str(),
              o.problem.empty() ? "pass" : ("FAIL: " + o.problem).c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> topics(argv + 1, argv + argc);
  const Form form = std::erase(topics, "--brief") > 0 ? Form::brief : Form::full;
  const StressList list = stress_list(form);
  const std::size_t tests = count_tests(list);

  std::printf("%-15s %-66s %-22s %12s   %-8s %6s %6s  %-10s\n", "topic", "case", "expected", "measured",
              "± error", "z", "leaks", "non-finite");
  int rows = 0, failed = 0;
  for (const StressCase& c : list.cases()) {
    if (!topics.empty() && std::ranges::find(topics, c.topic) == topics.end()) continue;
    const Outcome o = measure(c, form, tests);
    print_row(c, o);
    ++rows, failed += !o.problem.empty();
  }
  std::printf("\n%d cases, %d failed; a z of %.2f is significant (1 %% over all %zu means compared)\n", rows,
              failed, normal_threshold(sidak_significance(0.01, tests)), tests);
  if (rows == 0) std::printf("no case has such a topic\n");
  return rows > 0 && failed == 0 ? 0 : 1;
}
