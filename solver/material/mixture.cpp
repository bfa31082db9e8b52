#include "solver/material/mixture.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "solver/material/neo_hookean.h"

namespace mammotwin {

namespace {

std::array<double, 3> shear_moduli(const Mixture::Laws& laws) {
  return {laws[0]->shear_modulus(), laws[1]->shear_modulus(), laws[2]->shear_modulus()};
}

void check_fractions(const std::array<double, 3>& f) {
  double sum = 0;
  for (double value : f) sum += value >= 0 && value <= 1 + 1e-6 ? value : std::nan("");
  if (!(std::abs(sum - 1) <= 1e-6))
    throw std::invalid_argument("tissue fractions are " + std::to_string(f[0]) + ", " +
                                std::to_string(f[1]) + ", " + std::to_string(f[2]) +
                                "; expected three numbers in [0, 1] that sum to 1");
}

}  // namespace

double mixed_modulus(Mixing mixing, const std::array<double, 3>& f,
                     const std::array<double, 3>& mu) {
  double sum = 0;
  for (int t = 0; t < 3; ++t)
    sum += f[t] * (mixing == Mixing::arithmetic  ? mu[t]
                   : mixing == Mixing::geometric ? std::log(mu[t])
                                                 : 1 / mu[t]);
  return mixing == Mixing::arithmetic ? sum : mixing == Mixing::geometric ? std::exp(sum) : 1 / sum;
}

Mixture::Mixture(Mixing mixing, const std::array<double, 3>& fractions, const Laws& laws)
    : laws_(laws) {
  check_fractions(fractions);
  const auto mu = shear_moduli(laws);
  const double scale =
      mixed_modulus(mixing, fractions, mu) / mixed_modulus(Mixing::arithmetic, fractions, mu);
  for (int t = 0; t < 3; ++t) weights_[t] = scale * fractions[t];
}

double Mixture::energy(const Eigen::Matrix3d& F) const {
  double W = 0;
  for (int t = 0; t < 3; ++t)
    if (weights_[t] > 0) W += weights_[t] * laws_[t]->energy(F);
  return W;
}

Eigen::Matrix3d Mixture::stress(const Eigen::Matrix3d& F) const {
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  for (int t = 0; t < 3; ++t)
    if (weights_[t] > 0) P += weights_[t] * laws_[t]->stress(F);
  return P;
}

Material::Tangent Mixture::tangent(const Eigen::Matrix3d& F) const {
  Tangent A = Tangent::Zero();
  for (int t = 0; t < 3; ++t)
    if (weights_[t] > 0) A += weights_[t] * laws_[t]->tangent(F);
  return A;
}

std::shared_ptr<const Material> mix(Mixing mixing, const std::array<double, 3>& fractions,
                                    const Mixture::Laws& laws) {
  check_fractions(fractions);
  for (int t = 0; t < 3; ++t)
    if (fractions[t] == 1) return laws[t];
  for (const auto& law : laws)
    if (!dynamic_cast<const NeoHookean*>(law.get()))
      return std::make_shared<Mixture>(mixing, fractions, laws);
  return std::make_shared<NeoHookean>(mixed_modulus(mixing, fractions, shear_moduli(laws)) / 2);
}

double Mixture::shear_modulus() const {
  double mu = 0;
  for (int t = 0; t < 3; ++t) mu += weights_[t] * laws_[t]->shear_modulus();
  return mu;
}

}  // namespace mammotwin
