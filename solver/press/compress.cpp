#include "solver/press/compress.h"

#include <cmath>
#include <string>
#include <utility>

#include "solver/press/check_shape.h"
#include "solver/press/one_press.h"

namespace mammotwin {

namespace {

/// The first of several presses that is usable, else the first; its report counts the effort of
/// all.
class Presses {
 public:
  explicit Presses(CompressionResult first) : result_(std::move(first)) {}
  const CompressionReport& report() const { return result_.report; }
  void add(CompressionResult next);
  /// What was tried in vain, in the reason of a press that is not usable.
  void say_in_vain(const std::string& tried) { result_.report.reason += ", also " + tried; }
  CompressionResult take() { return std::move(result_); }

 private:
  CompressionResult result_;
};

void Presses::add(CompressionResult next) {
  if (next.report.usable() && !report().usable()) std::swap(result_, next);
  CompressionReport& kept = result_.report;
  const CompressionReport& other = next.report;
  kept.presses += other.presses;
  kept.other_press_iterations += other.newton_iterations;
  kept.newton_iterations += other.newton_iterations;
  kept.indefinite_matrices += other.indefinite_matrices;
  kept.seconds += other.seconds;
}

/// What is said of another press.
Progress once_more(const Progress& progress, const std::string& how) {
  if (!progress) return {};
  return [&progress, how](double done, const std::string& what) {
    progress(done, "once more, " + how + ": " + what);
  };
}

std::string drawn(double times) {
  return "drawn " + std::to_string(std::lround(times)) + " times as hard";
}

CompressionResult press_drawn(double times, const CompressionProblem& problem,
                              const CompressionOptions& options, const Progress& progress) {
  CompressionProblem harder = problem;
  harder.pull *= times;
  CompressionResult result =
      press_once(harder, options, times < options.most_drawn ? options.well_retained : 0,
                 once_more(progress, drawn(times)));
  result.report.drawn_times = times;
  return result;
}

/// Until the plates hold it.
void draw_harder(const CompressionProblem& problem, const CompressionOptions& options,
                 const Progress& progress, Presses& presses) {
  constexpr double harder = 2;
  double times = 1;
  while (!presses.report().usable() && harder * times <= options.most_drawn) {
    times *= harder;
    presses.add(press_drawn(times, problem, options, progress));
  }
  if (times > 1 && !presses.report().usable()) presses.say_in_vain(drawn(times));
}

CompressionResult press_carefully(const CompressionProblem& problem,
                                  const CompressionOptions& options, const Progress& progress) {
  CompressionOptions carefully = options;
  carefully.careful = true;
  carefully.longest_move /= 2;
  return press_once(problem, carefully, 0, once_more(progress, "carefully"));
}

}  // namespace

CompressionResult compress(const CompressionProblem& problem, const CompressionOptions& options,
                           const Progress& progress, const CompressionRestart& restart) {
  check_shape(problem);
  const bool can_be_drawn = !problem.pull.isZero() && options.most_drawn > 1;
  const double let_go_below = can_be_drawn ? options.well_retained : 0;
  Presses presses(press_once(problem, options, let_go_below, progress, restart));
  const CompressionReport& report = presses.report();
  const bool came_out = !report.history.empty() && report.retained_fraction < let_go_below;
  if (came_out && !report.usable()) draw_harder(problem, options, progress, presses);
  if (!report.usable() && !report.slipped_out && !report.history.empty() && !options.careful)
    presses.add(press_carefully(problem, options, progress));
  return presses.take();
}

CompressionResult compress_from(const CompressionResult& near, const CompressionProblem& problem,
                                const CompressionOptions& options) {
  check_shape(problem);
  return press_from(near, problem, options);
}

}  // namespace mammotwin
