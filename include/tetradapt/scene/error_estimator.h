// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_error_estimator_h
#define tetradapt_scene_error_estimator_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace tetradapt::scene
{
  /** The error estimators that a scene can ask for; estimate::Estimator says what
   * each computes. */
  enum class ErrorEstimator
  {
    energy,                     ///< energy norm of the difference to the reference
    ren,                        ///< the 2015 report's relative nodal error, summed over nodes
    exact,                      ///< energy norm of the true error (needs an exact displacement)
    degree_extrapolation,       ///< difference to the next degree, solved on the whole mesh
    local_degree_extrapolation, ///< the same, solved patch by patch
    richardson,                 ///< energy extrapolated over the cycles
    averaging,                  ///< Zienkiewicz-Zhu, nodal averages of the stress
    spr,                        ///< Zienkiewicz-Zhu, superconvergent patch recovery
    residual,                   ///< element residuals and jumps of the traction
    interpolation,              ///< interpolation error by a recovered Hessian
    goal,                       ///< dual weighted, error of a goal
    equilibrated                ///< guaranteed upper bound by an equilibrated stress
  };

  /** How the error is estimated; see scene.h for the three functions. */
  struct EstimationParameters
  {
    /** Estimators that every cycle computes in addition to the one that drives. */
    std::vector<ErrorEstimator> estimators;
    /** The goal that ErrorEstimator::goal is about; empty: the first. */
    std::string goal;

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };
} // namespace tetradapt::scene

#endif
