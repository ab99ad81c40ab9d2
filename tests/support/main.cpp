// Every test program's main: doctest's, and a failure if the validation layer reported anything, or
// if the filters of the command line leave no case.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>

#include "tests/support/bus_error.h"
#include "tests/support/kept.h"

namespace {

unsigned g_cases = 0;

struct Counter : doctest::IReporter {
  explicit Counter(const doctest::ContextOptions&) {}
  void report_query(const doctest::QueryData& data) override {
    g_cases = data.run_stats->numTestCasesPassingFilters;
  }
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats& stats) override {
    g_cases = stats.numTestCasesPassingFilters;
  }
  void test_case_start(const doctest::TestCaseData&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}
};

REGISTER_LISTENER("counter", 1, Counter);

}  // namespace

int main(int argc, char** argv) {
  vkh::test::explain_bus_errors();
  const int result = doctest::Context(argc, argv).run();
  if (g_cases == 0) {
    std::fprintf(stderr, "no test case is named so\n");
    return 1;
  }
  const uint32_t messages = vkh::test::validation_messages()();
  if (messages > 0) std::fprintf(stderr, "%u messages of the validation layer\n", messages);
  vkh::test::release_kept();
  return result != 0 ? result : (messages > 0 ? 1 : 0);
}
