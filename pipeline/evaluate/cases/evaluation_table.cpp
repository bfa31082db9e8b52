#include "pipeline/evaluate/cases/evaluation_table.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "pipeline/frame/products.h"

namespace mammotwin {

using nlohmann::json;

namespace {

bool of_one_breast(const json& a, const json& b) {
  return a.value("name", "") == b.value("name", "") && a.value("side", "") == b.value("side", "");
}

}  // namespace

EvaluationTable::EvaluationTable(const std::filesystem::path& file, bool keep)
    : file_(file), folder_(std::filesystem::absolute(file).parent_path()) {
  std::filesystem::create_directories(folder_);
  if (!keep || !std::filesystem::exists(file)) return;
  try {
    const json table = json::parse(std::ifstream(file));
    kept_ = table.at("cases").get<std::vector<json>>();
  } catch (const json::exception&) {
    throw std::runtime_error(file.string() + ": no table of an evaluation, whose rows could stay");
  }
}

void EvaluationTable::add(std::size_t number, json row, const std::string& said) {
  const std::lock_guard lock(mutex_);
  std::cerr << said << std::endl;
  rows_.resize(std::max(rows_.size(), number + 1));
  std::erase_if(kept_, [&](const json& other) { return of_one_breast(row, other); });
  rows_[number].push_back(std::move(row));
  write_text_atomically(file_, json{{"cases", all()}}.dump(1) + "\n");
}

void EvaluationTable::add(std::size_t number, json row) {
  const std::string said = row.dump();
  add(number, std::move(row), said);
}

json EvaluationTable::rows() const {
  const std::lock_guard lock(mutex_);
  return all();
}

json EvaluationTable::all() const {
  json all = json::array();
  for (const json& row : kept_) all.push_back(row);
  for (const auto& rows : rows_)
    for (const json& row : rows) all.push_back(row);
  return all;
}

void work_through(std::size_t cases, int jobs, const std::function<void(std::size_t)>& one) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> thrown(std::max(jobs, 1));
  std::vector<std::jthread> workers;
  for (std::exception_ptr& error : thrown)
    workers.emplace_back([&] {
      try {
        for (std::size_t n; (n = next++) < cases;) one(n);
      } catch (...) {
        error = std::current_exception();
        next = cases;
      }
    });
  workers.clear();  // joins
  for (const std::exception_ptr& error : thrown)
    if (error) std::rethrow_exception(error);
}

}  // namespace mammotwin
