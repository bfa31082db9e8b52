#include "segmentation/shading/n4.h"

#include <itkImage.h>
#include <itkMultiThreaderBase.h>
#include <itkN4BiasFieldCorrectionImageFilter.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

using Image = itk::Image<float, 3>;
using Mask = itk::Image<std::uint8_t, 3>;

constexpr unsigned levels = 2, control_points = 6, iterations = 40;
constexpr unsigned work_units = 4;  // fixed: sums are split by it, whatever the machine has
constexpr double convergence = 1e-4;

template <class T>
typename T::Pointer image_like(const RawImage& raw) {
  const auto image = T::New();
  typename T::SizeType size;
  typename T::SpacingType spacing;
  for (unsigned d = 0; d < 3; ++d) size[d] = raw.size[d], spacing[d] = raw.spacing[d];
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->Allocate();
  return image;
}

}  // namespace

std::vector<float> n4_log_bias(const RawImage& raw, const std::vector<std::uint8_t>& mask) {
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(work_units);
  const auto image = image_like<Image>(raw);
  const auto inside = image_like<Mask>(raw);
  std::copy(raw.values.begin(), raw.values.end(), image->GetBufferPointer());
  std::copy(mask.begin(), mask.end(), inside->GetBufferPointer());

  using N4 = itk::N4BiasFieldCorrectionImageFilter<Image, Mask, Image>;
  const auto n4 = N4::New();
  n4->SetInput(image);
  n4->SetMaskImage(inside);
  n4->SetMaskLabel(1);
  n4->SetNumberOfFittingLevels(levels);
  n4->SetNumberOfControlPoints(control_points);
  N4::VariableSizeArrayType most(levels);
  most.Fill(iterations);
  n4->SetMaximumNumberOfIterations(most);
  n4->SetConvergenceThreshold(convergence);
  n4->SetNumberOfWorkUnits(work_units);
  n4->Update();

  const float* corrected = n4->GetOutput()->GetBufferPointer();
  std::vector<float> log_bias(raw.values.size());
  for (std::size_t v = 0; v < log_bias.size(); ++v)
    log_bias[v] = std::log(raw.values[v] / std::max(corrected[v], 1e-12F));
  return log_bias;
}

}  // namespace mammotwin
