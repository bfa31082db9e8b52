#include "segmentation/image/tube_response.h"

#include <itkHessianRecursiveGaussianImageFilter.h>
#include <itkImage.h>

#include <algorithm>

namespace mammotwin {
namespace {

using Image = itk::Image<float, 3>;
using Tensor = itk::SymmetricSecondRankTensor<float, 3>;
using Tensors = itk::Image<Tensor, 3>;

Image::Pointer itk_image(const std::array<int, 3>& size, const std::array<double, 3>& spacing_mm,
                         const std::vector<float>& values) {
  const auto image = Image::New();
  Image::SizeType extent;
  std::copy(size.begin(), size.end(), extent.begin());
  image->SetRegions(extent);
  image->SetSpacing(spacing_mm.data());
  image->Allocate();
  std::copy(values.begin(), values.end(), image->GetBufferPointer());
  return image;
}

float response(const Tensor& hessian) {
  constexpr float roundness = 0.4F;  // of the section: a sheet curves one way only
  Tensor::EigenValuesArrayType e;    // ascending
  hessian.ComputeEigenValues(e);
  if (e[1] >= 0 || e[1] > roundness * e[0]) return 0;
  return std::max(0.0F, -e[1] - std::max(-e[2], 0.0F));
}

}  // namespace

std::vector<float> tube_response(const std::array<int, 3>& size,
                                 const std::array<double, 3>& spacing_mm,
                                 const std::vector<float>& image,
                                 const std::vector<std::uint8_t>& where, double sigma_mm) {
  constexpr unsigned work_units = 4;  // fixed, as wherever ITK is used
  std::vector<float> responses(image.size(), 0);
  if (image.empty() || *std::min_element(size.begin(), size.end()) < 4) return responses;
  const auto filter = itk::HessianRecursiveGaussianImageFilter<Image, Tensors>::New();
  filter->SetInput(itk_image(size, spacing_mm, image));
  filter->SetSigma(sigma_mm);
  filter->SetNormalizeAcrossScale(true);
  filter->SetNumberOfWorkUnits(work_units);
  filter->Update();
  const Tensor* hessians = filter->GetOutput()->GetBufferPointer();
  for (std::size_t v = 0; v < responses.size(); ++v)
    if (where[v]) responses[v] = response(hessians[v]);
  return responses;
}

}  // namespace mammotwin
