#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/pipeline/command.h"

namespace mammotwin {

/// The scripts of `make` on one patient.
struct ChainRun {
  std::string patient;
  std::filesystem::path data, results;

  std::vector<std::string> environment() const;
  /// `script` of pipeline/, with or without a target.
  CommandResult run_script(const std::string& script, const std::string& target = "") const;
  /// The first product that is not finished: "report.html" where only that is missing.
  std::string next_product() const;
  /// Names and bytes of the patient's products; sidecars, which hold times, are left out.
  std::map<std::string, std::string> products() const;
};

/// Begins the chain from an empty folder, kills it with SIGKILL after a random time and goes on
/// from there, up to `most_a_chain` times before it may end, and begins anew until it was killed
/// `kills` times; `interval_s` of running apart on average (uniform from 0 to twice that). After
/// each kill nothing may be half-written, and what was finished before must not have been made
/// again; each chain that comes to its end must hold what `expected` holds, byte for byte.
void expect_nothing_lost_to_kills(const ChainRun& chain, int kills, int most_a_chain,
                                  double interval_s,
                                  const std::map<std::string, std::string>& expected);

/// Kills each stage of a finished chain at single steps in the results folder (files opened,
/// written, renamed, removed, fsync; fault_layer.cpp), `kills` of them spread evenly over all, from
/// what the stages before have left; run again, it must hold the same products, byte for byte, and
/// nothing half-written. `scratch`: for the layer and for copies.
void expect_nothing_lost_at_steps(const ChainRun& chain, int kills,
                                  const std::filesystem::path& scratch);

}  // namespace mammotwin
