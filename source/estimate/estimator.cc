// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/estimator.h"

#include "tetradapt/estimate/equilibrated/equilibrated.h"
#include "tetradapt/estimate/extrapolation.h"
#include "tetradapt/estimate/flux_projection.h"
#include "tetradapt/estimate/goal_oriented.h"
#include "tetradapt/estimate/interpolation.h"
#include "tetradapt/estimate/residual.h"

#include <stdexcept>

namespace tetradapt::estimate
{
  std::unique_ptr<Estimator>
  make_estimator(const scene::ErrorEstimator which)
  {
    using scene::ErrorEstimator;
    switch (which)
      {
      case ErrorEstimator::energy:
        return std::make_unique<ExtrapolationEnergy>();
      case ErrorEstimator::ren:
        return std::make_unique<ExtrapolationRen>();
      case ErrorEstimator::exact:
        return std::make_unique<ExactEnergy>();
      case ErrorEstimator::degree_extrapolation:
        return std::make_unique<DegreeExtrapolation>();
      case ErrorEstimator::local_degree_extrapolation:
        return std::make_unique<LocalDegreeExtrapolation>();
      case ErrorEstimator::richardson:
        return std::make_unique<Richardson>();
      case ErrorEstimator::averaging:
        return std::make_unique<Averaging>();
      case ErrorEstimator::spr:
        return std::make_unique<PatchRecovery>();
      case ErrorEstimator::residual:
        return std::make_unique<Residual>();
      case ErrorEstimator::interpolation:
        return std::make_unique<Interpolation>();
      case ErrorEstimator::goal:
        return std::make_unique<GoalOriented>();
      case ErrorEstimator::equilibrated:
        return std::make_unique<Equilibrated>();
      }
    throw std::logic_error("Not an error estimator.");
  }
} // namespace tetradapt::estimate
