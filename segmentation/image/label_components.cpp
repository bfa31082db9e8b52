#include "segmentation/image/label_components.h"

#include <itkConnectedComponentImageFilter.h>
#include <itkImage.h>

#include <algorithm>

namespace mammotwin {

std::vector<std::int32_t> label_components(const std::array<int, 3>& size,
                                           const std::vector<std::uint8_t>& mask) {
  using Mask = itk::Image<std::uint8_t, 3>;
  using Labels = itk::Image<std::int32_t, 3>;
  constexpr unsigned work_units = 4;  // fixed, as wherever ITK is used
  if (mask.empty()) return {};
  const auto image = Mask::New();
  Mask::SizeType extent;
  std::copy(size.begin(), size.end(), extent.begin());
  image->SetRegions(extent);
  image->Allocate();
  std::copy(mask.begin(), mask.end(), image->GetBufferPointer());
  const auto filter = itk::ConnectedComponentImageFilter<Mask, Labels>::New();
  filter->SetInput(image);
  filter->SetNumberOfWorkUnits(work_units);
  filter->Update();
  const std::int32_t* labels = filter->GetOutput()->GetBufferPointer();
  return {labels, labels + mask.size()};
}

}  // namespace mammotwin
