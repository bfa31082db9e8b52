#include "pipeline/frame/settings_table.h"

#include "pipeline/patient/patient.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

using SettingsTableTest = ScratchFolder;

TEST_F(SettingsTableTest, IsTheOneInTheDocumentation) {
  const std::string page = text_of(MAMMOTWIN_SOURCE_DIR "/docs/settings.md");
  const std::string begin = "--list-settings` -->\n", end = "<!-- end of settings -->";
  const std::size_t from = page.find(begin), to = page.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  Patient patient;
  Settings settings;
  patient.declare(settings);
  EXPECT_EQ(page.substr(from + begin.size(), to - from - begin.size()),
            settings_table(settings, patient.list_settings()))
      << "put the output of `mammotwin-segment --list-settings` into docs/settings.md";
}

}  // namespace
}  // namespace mammotwin
