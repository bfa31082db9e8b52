// evaluate-registration: synthetic patients with known marks, from MRI and mammograms -> one table.

#include <atomic>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "pipeline/evaluate/registration_case.h"
#include "pipeline/evaluate/registration_rows.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path table;
  int synthetic = 10, first = 0, jobs = 2;
  bool coarse = false, judge = false;
};

void declare(CommandLine& command, Arguments& args) {
  command
      .option("table", args.table,
              "registration.json to write; each patient's files go to the folder registration "
              "beside it")
      .required();
  command.option("--synthetic", args.synthetic, "patients").between(1, 10000).with_default();
  command.option("--first", args.first, "the first of them").between(0, 10000).with_default();
  command.option("--jobs", args.jobs, "patients at a time, each on all cores [1 to 64]")
      .between(1, 64)
      .with_default();
  command.flag("--coarse", args.coarse,
               "few elements in the truth and in the model: seconds a patient, to try it out");
  command.flag("--judge", args.judge, "judge what lies there, without making or running anything");
}

json evaluate(int number, const fs::path& folder, const Arguments& args) {
  json row = empty_registration_row();
  row["name"] = "synthetic-" + std::to_string(number);
  row["reason"] = nullptr;
  try {
    if (!args.judge) {
      make_registration_case(number, args.coarse, folder);
      run_registration_case(folder);
    }
    row.update(registration_row(folder));
  } catch (const std::exception& error) {
    row["reason"] = error.what();
  }
  return row;
}

json done_of(const std::vector<json>& rows) {
  json cases = json::array();
  for (const json& row : rows)
    if (!row.is_null()) cases.push_back(row);
  return cases;
}

int run(const Arguments& args) {
  const fs::path beside = fs::absolute(args.table).parent_path() / "registration";
  fs::create_directories(beside);
  std::vector<json> rows(args.synthetic);
  std::atomic<int> next = 0;
  std::mutex mutex;
  const auto work = [&] {
    for (int n; (n = next++) < args.synthetic;) {
      const int number = args.first + n;
      json row = evaluate(number, beside / ("synthetic-" + std::to_string(number)), args);
      const std::lock_guard lock(mutex);
      std::cerr << row["name"] << " " << row["reason"] << " CC " << row["tre_cc_mm"] << " MLO "
                << row["tre_mlo_mm"] << " 3-D " << row["tre_3d_mm"] << " mm" << std::endl;
      rows[n] = std::move(row);
      write_text_atomically(args.table, json{{"cases", done_of(rows)}}.dump(1) + "\n");
    }
  };
  std::vector<std::jthread> workers;
  for (int job = 0; job < args.jobs; ++job) workers.emplace_back(work);
  workers.clear();  // joins
  std::cerr << registration_summary(done_of(rows));
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "evaluate-registration",
                                      "Registers synthetic patients with mammograms of another "
                                      "model, and writes how far off the marks are",
                                      declare, run);
}
