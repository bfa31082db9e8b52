#include "tests/pipeline/cohort/cohort_folder.h"

#include <sstream>

namespace mammotwin {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> values;
  std::size_t begin = 0;
  for (std::size_t tab; (tab = line.find('\t', begin)) != std::string::npos; begin = tab + 1)
    values.push_back(line.substr(begin, tab - begin));
  values.push_back(line.substr(begin));
  return values;
}

}  // namespace

std::map<std::string, std::map<std::string, std::string>> CohortFolderTest::table(
    const std::string& name) const {
  std::istringstream in(text_of(results(name)));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> columns = cells(line);
  std::map<std::string, std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> values = cells(line);
    EXPECT_EQ(values.size(), columns.size()) << line;
    for (std::size_t i = 0; i < std::min(values.size(), columns.size()); ++i)
      rows[values[0]][columns[i]] = values[i];
  }
  return rows;
}

}  // namespace mammotwin
