#include "registration/mammogram/mammogram_masks.h"

#include <itkBinShrinkImageFilter.h>
#include <itkBinaryMorphologicalOpeningImageFilter.h>
#include <itkBinaryThresholdImageFilter.h>
#include <itkConnectedComponentImageFilter.h>
#include <itkConstantPadImageFilter.h>
#include <itkContourExtractor2DImageFilter.h>
#include <itkFlatStructuringElement.h>
#include <itkImage.h>
#include <itkImageToHistogramFilter.h>
#include <itkOtsuThresholdCalculator.h>
#include <itkRelabelComponentImageFilter.h>
#include <itkSmoothingRecursiveGaussianImageFilter.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace mammotwin {
namespace {

using GreyImage = itk::Image<float, 2>;
using LabelImage = itk::Image<std::uint32_t, 2>;

constexpr unsigned kWorkUnits = 4;  // fixed, so that results do not depend on the machine

GreyImage::Pointer to_itk(const MammogramImage& image) {
  auto grey = GreyImage::New();
  grey->SetRegions(GreyImage::SizeType{{static_cast<itk::SizeValueType>(image.columns),
                                        static_cast<itk::SizeValueType>(image.rows)}});
  grey->Allocate();
  std::copy(image.grey.begin(), image.grey.end(), grey->GetBufferPointer());
  return grey;
}

MammogramImage from_itk(const GreyImage& grey) {
  const auto size = grey.GetLargestPossibleRegion().GetSize();
  MammogramImage image{static_cast<int>(size[0]), static_cast<int>(size[1]), {}};
  image.grey.assign(grey.GetBufferPointer(), grey.GetBufferPointer() + size[0] * size[1]);
  return image;
}

}  // namespace

MammogramImage smoothed(const MammogramImage& image, double sigma) {
  auto filter = itk::SmoothingRecursiveGaussianImageFilter<GreyImage, GreyImage>::New();
  filter->SetInput(to_itk(image));
  filter->SetSigma(sigma);
  filter->SetNumberOfWorkUnits(kWorkUnits);
  filter->Update();
  return from_itk(*filter->GetOutput());
}

MammogramImage shrunk(const MammogramImage& image, int factor) {
  auto filter = itk::BinShrinkImageFilter<GreyImage, GreyImage>::New();
  filter->SetInput(to_itk(image));
  filter->SetShrinkFactors(factor);
  filter->SetNumberOfWorkUnits(kWorkUnits);
  filter->Update();
  return from_itk(*filter->GetOutput());
}

float otsu_threshold(const MammogramImage& image) {
  using Histograms = itk::Statistics::ImageToHistogramFilter<GreyImage>;
  constexpr unsigned kBins = 256;
  auto histogram = Histograms::New();
  histogram->SetInput(to_itk(image));
  histogram->SetHistogramSize(Histograms::HistogramSizeType(1, kBins));
  histogram->SetAutoMinimumMaximum(true);
  histogram->SetNumberOfWorkUnits(kWorkUnits);
  auto otsu = itk::OtsuThresholdCalculator<Histograms::HistogramType, float>::New();
  otsu->SetInput(histogram->GetOutput());
  otsu->Update();
  return otsu->GetThreshold();
}

std::vector<std::uint32_t> regions_above(const MammogramImage& image, float threshold) {
  auto above = itk::BinaryThresholdImageFilter<GreyImage, LabelImage>::New();
  above->SetInput(to_itk(image));
  above->SetLowerThreshold(threshold);
  above->SetUpperThreshold(std::numeric_limits<float>::max());
  above->SetInsideValue(1);
  above->SetOutsideValue(0);
  above->SetNumberOfWorkUnits(kWorkUnits);
  auto components = itk::ConnectedComponentImageFilter<LabelImage, LabelImage>::New();
  components->SetInput(above->GetOutput());
  components->SetNumberOfWorkUnits(kWorkUnits);
  auto by_size = itk::RelabelComponentImageFilter<LabelImage, LabelImage>::New();
  by_size->SetInput(components->GetOutput());
  by_size->SetNumberOfWorkUnits(kWorkUnits);
  by_size->Update();
  const std::uint32_t* labels = by_size->GetOutput()->GetBufferPointer();
  return {labels, labels + image.grey.size()};
}

MammogramImage opened(const MammogramImage& mask, int radius) {
  using Disc = itk::FlatStructuringElement<2>;
  auto filter = itk::BinaryMorphologicalOpeningImageFilter<GreyImage, GreyImage, Disc>::New();
  filter->SetInput(to_itk(mask));
  filter->SetKernel(Disc::Ball(Disc::RadiusType::Filled(radius)));
  filter->SetForegroundValue(1);
  filter->SetBackgroundValue(0);
  filter->SetNumberOfWorkUnits(kWorkUnits);
  filter->Update();
  return from_itk(*filter->GetOutput());
}

std::vector<std::array<double, 2>> longest_border(const MammogramImage& mask) {
  auto padded = itk::ConstantPadImageFilter<GreyImage, GreyImage>::New();
  padded->SetInput(to_itk(mask));
  padded->SetPadBound(GreyImage::SizeType::Filled(1));
  padded->SetConstant(0);
  auto contours = itk::ContourExtractor2DImageFilter<GreyImage>::New();
  contours->SetInput(padded->GetOutput());
  contours->SetContourValue(0.5);
  contours->Update();
  std::vector<std::array<double, 2>> longest;
  for (unsigned n = 0; n < contours->GetNumberOfOutputs(); ++n) {
    const auto* vertices = contours->GetOutput(n)->GetVertexList();
    if (vertices->size() <= longest.size()) continue;
    longest.clear();
    for (const auto& vertex : *vertices) longest.push_back({vertex[0], vertex[1]});
  }
  return longest;
}

}  // namespace mammotwin
