#include "pipeline/evaluate/cases/evaluation_table.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <stdexcept>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Evaluation : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("mammotwin_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  json on_disk() const { return json::parse(std::ifstream(folder_ / "new" / "table.json")); }

  fs::path folder_;
};

TEST_F(Evaluation, RowsStandInTheOrderOfTheirCasesAfterEachOfThem) {
  EvaluationTable table(folder_ / "new" / "table.json");
  table.add(2, {{"name", "c"}});
  EXPECT_EQ(on_disk()["cases"].size(), 1u);
  table.add(0, {{"name", "a"}}, "said");
  table.add(0, {{"name", "b"}}, "said");
  const json expected = {{{"name", "a"}}, {{"name", "b"}}, {{"name", "c"}}};
  EXPECT_EQ(table.rows(), expected);
  EXPECT_EQ(on_disk()["cases"], expected);
  EXPECT_EQ(table.folder(), fs::absolute(folder_ / "new"));
}

TEST_F(Evaluation, RowsOfOtherBreastsStayWhereThatIsAsked) {
  const fs::path file = folder_ / "new" / "table.json";
  const json a_left = {{"name", "a"}, {"side", "left"}, {"x", 1}},
             a_right = {{"name", "a"}, {"side", "right"}, {"x", 2}};
  EvaluationTable(file, true).add(0, a_left);
  EvaluationTable(file, true).add(0, a_right);
  json again = a_left;
  again["x"] = 3;
  EvaluationTable(file, true).add(5, again);
  EXPECT_EQ(on_disk()["cases"], json({a_right, again}));
  EvaluationTable(file).add(0, a_left);
  EXPECT_EQ(on_disk()["cases"], json::array({a_left}));
  std::ofstream(file) << "{}";
  EXPECT_THROW(EvaluationTable(file, true), std::runtime_error);
}

TEST_F(Evaluation, EachCaseIsWorkedOnOnceAndItsRowKept) {
  EvaluationTable table(folder_ / "new" / "table.json");
  work_through(40, 4, [&](std::size_t n) { table.add(n, {{"case", n}}, std::to_string(n)); });
  ASSERT_EQ(on_disk()["cases"].size(), 40u);
  for (std::size_t n = 0; n < 40; ++n) EXPECT_EQ(on_disk()["cases"][n]["case"], n);
}

TEST_F(Evaluation, AnErrorEndsTheWorkAndIsThrown) {
  std::atomic<int> begun = 0;
  const auto one = [&](std::size_t n) {
    ++begun;
    if (n == 3) throw std::runtime_error("case 3");
  };
  EXPECT_THROW(work_through(1000, 1, one), std::runtime_error);
  EXPECT_EQ(begun, 4);
}

}  // namespace
}  // namespace mammotwin
