#include "solver/press/checkpoint.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace mammotwin {

namespace {

using nlohmann::json;

constexpr int kNodeDoubles = 24;

json to_json(const std::vector<HermiteMesh::Node>& nodes) {
  std::vector<double> x;
  for (const HermiteMesh::Node& node : nodes)
    x.insert(x.end(), node.data(), node.data() + node.size());
  return x;
}

std::vector<HermiteMesh::Node> nodes_from(const json& from) {
  const std::vector<double> x = from;
  if (x.size() % kNodeDoubles != 0) throw std::runtime_error("nodes are cut off");
  std::vector<HermiteMesh::Node> nodes;
  for (std::size_t i = 0; i < x.size(); i += kNodeDoubles)
    nodes.push_back(Eigen::Map<const HermiteMesh::Node>(x.data() + i));
  return nodes;
}

json to_json(const State& state) { return {{"x", to_json(state.x)}, {"pressure", state.pressure}}; }

State state_from(const json& from) {
  return {nodes_from(from.at("x")), from.at("pressure").get<std::vector<double>>()};
}

json to_json(const CompressionCheckpoint::GoodStep& step) {
  return {{"fraction", step.fraction}, {"state", to_json(step.state)}};
}

CompressionCheckpoint::GoodStep good_step_from(const json& from) {
  return {from.at("fraction"), state_from(from.at("state"))};
}

json to_json(const LoadSteppingReport& load) {
  return {load.reached,    load.steps,  load.cutbacks, load.iterations,
          load.indefinite, load.reason, load.next_step};
}

LoadSteppingReport load_from(const json& from) {
  return {from.at(0), from.at(1), from.at(2), from.at(3), from.at(4), from.at(5), from.at(6)};
}

json to_json(const PlateFriction::History& history) {
  std::vector<double> all;
  for (const PlateFriction::Contact& c : history) {
    all.insert(all.end(), c.anchor.begin(), c.anchor.end());
    all.insert(all.end(), c.normal.begin(), c.normal.end());
    all.push_back(c.pressure);
  }
  return all;
}

PlateFriction::History history_from(const json& from) {
  constexpr std::size_t doubles = 7;
  const std::vector<double> all = from;
  if (all.size() % doubles != 0) throw std::runtime_error("friction's history is cut off");
  PlateFriction::History history;
  for (std::size_t i = 0; i < all.size(); i += doubles)
    history.push_back({Eigen::Vector3d(all[i], all[i + 1], all[i + 2]),
                       Eigen::Vector3d(all[i + 3], all[i + 4], all[i + 5]), all[i + 6]});
  return history;
}

json to_json(const CompressionReport& report) {
  json history = json::array();
  for (const CompressionStep& s : report.history)
    history.push_back({s.thickness_mm, s.force_N, s.iterations, s.penalty, s.min_J, s.max_J,
                       to_json(s.deformed)});
  return {{"newton_iterations", report.newton_iterations},
          {"indefinite_matrices", report.indefinite_matrices},
          {"history", history}};
}

CompressionReport report_from(const json& from) {
  CompressionReport report;
  report.newton_iterations = from.at("newton_iterations");
  report.indefinite_matrices = from.at("indefinite_matrices");
  for (const json& s : from.at("history"))
    report.history.push_back(
        {s.at(0), s.at(1), s.at(2), s.at(3), s.at(4), s.at(5), nodes_from(s.at(6))});
  return report;
}

}  // namespace

std::vector<std::uint8_t> encode_checkpoint(const CompressionCheckpoint& c,
                                            const std::string& run) {
  return json::to_cbor({{"run", run},
                        {"found", to_json(c.found)},
                        {"load", to_json(c.load)},
                        {"before", to_json(c.before)},
                        {"reached", to_json(c.reached)},
                        {"tilt", c.tilt},
                        {"penalty", c.penalty},
                        {"sticking", to_json(c.sticking)},
                        {"report", to_json(c.report)}});
}

CompressionCheckpoint decode_checkpoint(const std::vector<std::uint8_t>& bytes,
                                        const std::string& run) {
  try {
    const json from = json::from_cbor(bytes);
    if (from.at("run") != run) throw std::runtime_error("it is of another run");
    return {nodes_from(from.at("found")),
            load_from(from.at("load")),
            good_step_from(from.at("before")),
            good_step_from(from.at("reached")),
            from.at("tilt"),
            from.at("penalty"),
            history_from(from.at("sticking")),
            report_from(from.at("report"))};
  } catch (const json::exception&) {
    throw std::runtime_error("checkpoint cannot be used: it is damaged");
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("checkpoint cannot be used: ") + error.what());
  }
}

}  // namespace mammotwin
