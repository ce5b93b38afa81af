#include <gtest/gtest.h>

#include <set>

#include "stress_case.h"

namespace photopic {
namespace {

using namespace test;

const StressList& brief_list() {
  static const StressList list = stress_list(Form::brief);
  return list;
}

std::vector<std::string> topics() {
  std::vector<std::string> names;
  for (const StressCase& c : brief_list().cases())
    if (std::ranges::find(names, c.topic) == names.end()) names.push_back(c.topic);
  return names;
}

/// The short form of the stress table, a test a topic.
class StressTable : public ::testing::TestWithParam<std::string> {};

TEST_P(StressTable, Holds) {
  static const std::size_t tests = count_tests(brief_list());
  for (const StressCase& c : brief_list().cases()) {
    if (c.topic != GetParam()) continue;
    const Outcome o = measure(c, Form::brief, tests);
    EXPECT_EQ(o.problem, "") << c.name << ": expected " << o.expected << ", measured " << o.measured.mean
                             << " ± " << o.measured.error << ", z " << o.z << ", " << o.stats.non_finite
                             << " not finite";
  }
}

std::string identifier(const ::testing::TestParamInfo<std::string>& info) {
  std::string name;
  for (const char c : info.param) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Topics, StressTable, ::testing::ValuesIn(topics()), identifier);

/// Rows are told apart by topic and name.
TEST(StressTable, NamesEachCaseOnce) {
  for (const Form form : {Form::brief, Form::full}) {
    std::set<std::string> names;
    const StressList list = stress_list(form);
    for (const StressCase& c : list.cases())
      EXPECT_TRUE(names.insert(c.topic + ": " + c.name).second) << c.name;
  }
}

}  // namespace
}  // namespace photopic
