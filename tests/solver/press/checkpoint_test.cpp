#include "solver/press/checkpoint.h"

#include <gtest/gtest.h>

#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

constexpr char kRun[] = "the dome";

struct Case {
  const char* name;
  double friction, tilt_spring, gravity, pull;
};

/// Coarse, with plates that move by 3 mm a step, so that there are several steps to stop after.
CompressionProblem problem_of(const Case& c) {
  CompressionProblem problem = dome_problem(80);
  problem.mesh = dome_breast({3, 3, 1});
  problem.friction.coefficient = c.friction;
  problem.plates.tilt_spring = c.tilt_spring;
  problem.gravity = {0, -c.gravity, 0};
  problem.pull = c.pull * problem.plates.depth;
  return problem;
}

CompressionOptions small_steps() {
  CompressionOptions options;
  options.longest_move = 3;
  return options;
}

class ResumedCompression : public testing::TestWithParam<Case> {};

TEST_P(ResumedCompression, EndsAsTheUninterruptedOneBitForBit) {
  const CompressionProblem problem = problem_of(GetParam());
  std::vector<std::vector<std::uint8_t>> kept;
  CompressionRestart keeping;
  keeping.keep = [&](const CompressionCheckpoint& c) {
    kept.push_back(encode_checkpoint(c, kRun));
  };
  const CompressionResult whole = compress(problem, small_steps(), {}, keeping);
  ASSERT_TRUE(whole.report.usable()) << whole.report.reason;
  ASSERT_GE(kept.size(), 3u);
  for (const std::size_t stopped_after : {std::size_t{0}, kept.size() - 1}) {
    const CompressionCheckpoint from = decode_checkpoint(kept[stopped_after], kRun);
    const CompressionResult resumed = compress(problem, small_steps(), {}, {&from, {}});
    EXPECT_EQ(resumed.deformed, whole.deformed) << "after step " << stopped_after;
    EXPECT_EQ(resumed.pressure, whole.pressure);
    EXPECT_EQ(resumed.report.force_N, whole.report.force_N);
    EXPECT_EQ(resumed.report.newton_iterations, whole.report.newton_iterations);
    EXPECT_EQ(resumed.report.steps, whole.report.steps);
    ASSERT_EQ(resumed.report.history.size(), whole.report.history.size());
    for (std::size_t s = 0; s < whole.report.history.size(); ++s)
      EXPECT_EQ(resumed.report.history[s].deformed, whole.report.history[s].deformed);
  }
}

INSTANTIATE_TEST_SUITE_P(Plates, ResumedCompression,
                         testing::Values(Case{"level", 0, PlateOptions::kEndless, 0, 0},
                                         Case{"friction", 0.1, PlateOptions::kEndless, 0, 0},
                                         Case{"sprung", 0, 5e6, 0, 0},
                                         Case{"hanging", 0, PlateOptions::kEndless, 3000, 0},
                                         Case{"pulled", 0.1, PlateOptions::kEndless, 0, 0.003}),
                         [](const auto& info) { return info.param.name; });

CompressionCheckpoint small_checkpoint() {
  CompressionCheckpoint c;
  c.reached.fraction = 0.5;
  c.reached.state.x.assign(2, HermiteMesh::Node::Constant(1.0 / 3));
  c.reached.state.pressure = {0.1};
  return c;
}

std::string refusal(const std::vector<std::uint8_t>& bytes) {
  try {
    decode_checkpoint(bytes, kRun);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Checkpoint, IsRefusedWhenCutOffAtAnyByte) {
  const auto bytes = encode_checkpoint(small_checkpoint(), kRun);
  EXPECT_EQ(refusal(bytes), "");
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(refusal({bytes.begin(), bytes.begin() + size}).find("cannot be used"),
              std::string::npos)
        << size;
}

TEST(Checkpoint, OfAnotherRunIsRefused) {
  EXPECT_NE(refusal(encode_checkpoint(small_checkpoint(), "another")).find("another run"),
            std::string::npos);
}

TEST(Checkpoint, OfAnotherMeshIsRefused) {
  const CompressionCheckpoint small = small_checkpoint();
  EXPECT_THROW(compress(problem_of({"", 0, PlateOptions::kEndless, 0, 0}), {}, {}, {&small, {}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
