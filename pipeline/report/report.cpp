#include "pipeline/report/report.h"

#include <fstream>
#include <stdexcept>

#include "pipeline/report/figures/frames_figure.h"
#include "pipeline/report/figures/overview_picture.h"
#include "pipeline/report/page_data.h"
#include "pipeline/report/page_template.h"

namespace mammotwin {

void write_report(const PatientResults& results, const std::filesystem::path& page,
                  const std::string& version) {
  std::ofstream out(page, std::ios::binary);
  out << render_page(page_data(results, version));
  out.close();
  if (!out) throw std::runtime_error(page.string() + ": cannot be written; is the disk full?");
}

void write_report_picture(const PatientResults& results, const std::filesystem::path& png) {
  constexpr double kPixelsPerPoint = 2;
  overview_picture(results).write_png(png, kPixelsPerPoint);
}

void write_frames_picture(const std::filesystem::path& png) {
  constexpr double kPixelsPerPoint = 1.5;
  frames_figure().picture.write_png(png, kPixelsPerPoint);
}

}  // namespace mammotwin
