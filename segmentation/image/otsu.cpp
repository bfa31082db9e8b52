#include "segmentation/image/otsu.h"

#include <itkHistogram.h>
#include <itkOtsuThresholdCalculator.h>

#include <algorithm>

namespace mammotwin {

double otsu_threshold(const std::vector<float>& values, double high) {
  using Histogram = itk::Statistics::Histogram<double>;
  constexpr int bins = 256;
  if (values.empty()) return 0;
  const auto histogram = Histogram::New();
  histogram->SetMeasurementVectorSize(1);
  Histogram::SizeType size(1);
  Histogram::MeasurementVectorType lower(1), upper(1);
  size.Fill(bins);
  lower.Fill(0);
  upper.Fill(high * bins / (bins - 1));  // the last bin begins at `high`
  histogram->Initialize(size, lower, upper);
  for (const float value : values) {
    const double share = std::clamp(value / high, 0.0, 1.0);
    histogram->IncreaseFrequency(static_cast<std::size_t>(share * (bins - 1)), 1);
  }
  const auto otsu = itk::OtsuThresholdCalculator<Histogram, double>::New();
  otsu->SetInput(histogram);
  otsu->Update();
  return otsu->GetThreshold();
}

}  // namespace mammotwin
