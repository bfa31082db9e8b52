#include "pipeline/evaluate/cases/spline_resampled.h"

#include <itkBSplineInterpolateImageFunction.h>
#include <itkImage.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace mammotwin {
namespace {

/// What stands at a place between voxels.
class Spline {
 public:
  explicit Spline(const Volume<float>& grey) : grey_(grey) {
    const auto image = Image::New();
    image->SetRegions(Image::SizeType{static_cast<itk::SizeValueType>(grey.size.x()),
                                      static_cast<itk::SizeValueType>(grey.size.y()),
                                      static_cast<itk::SizeValueType>(grey.size.z())});
    image->Allocate();
    std::copy(grey.values.begin(), grey.values.end(), image->GetBufferPointer());
    spline_->SetSplineOrder(3);
    spline_->SetInputImage(image);
  }

  float at(const Eigen::Vector3d& x, Beyond beyond) const {
    Eigen::Vector3d index = grey_.index(x);
    if (beyond == Beyond::border)
      index = index.cwiseMax(0.0).cwiseMin((grey_.size.cast<double>().array() - 1).matrix());
    const Function::ContinuousIndexType place(index.data());
    if (!spline_->IsInsideBuffer(place)) return 0;
    return std::max(0.0F, static_cast<float>(spline_->EvaluateAtContinuousIndex(place)));
  }

 private:
  using Image = itk::Image<float, 3>;
  using Function = itk::BSplineInterpolateImageFunction<Image, double, float>;
  const Volume<float>& grey_;
  Function::Pointer spline_ = Function::New();
};

}  // namespace

Volume<float> spline_resampled(const Volume<float>& image, Volume<float> onto,
                               const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& from,
                               Beyond beyond) {
  const Spline spline(image);
  tbb::parallel_for(0, onto.size.z(), [&](int k) {
    for (int j = 0; j < onto.size.y(); ++j)
      for (int i = 0; i < onto.size.x(); ++i)
        onto(i, j, k) = spline.at(from(onto.position(i, j, k)), beyond);
  });
  return onto;
}

}  // namespace mammotwin
