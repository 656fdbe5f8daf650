// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_estimator_h
#define tetradapt_estimate_estimator_h

#include "tetradapt/estimate/comparison.h"
#include "tetradapt/scene/scene.h"
#include "tetradapt/solve/static_solution.h"

#include <memory>
#include <string>
#include <vector>

namespace tetradapt::estimate
{
  /** How large the error is, and where. */
  struct Estimate
  {
    /** eta_K >= 0, one a cell. Whatever the estimator: sizes are found as if their
     * squares added up and fell with h^(2p). Empty: it knows no distribution. */
    std::vector<double> indicators;
    double              global = 0.; ///< see EstimatorTraits::is_energy_norm
    /** Not enough is known yet (the first cycles of an extrapolation over
     * cycles): there is no estimate in this cycle. */
    bool missing = false;
  };

  /** The energy of one mesh of a run. */
  struct EnergyLevel
  {
    unsigned long n_dofs = 0;
    double        energy = 0.; ///< a(u_h,u_h)
  };

  /** What an estimator works with: the solution and its comparisons, through
   * which it shares whatever others have computed already. References are valid
   * during the call only. */
  struct EstimateInput
  {
    Comparison                     &comparison;
    const scene::Scene             &scene;
    const solve::StaticSolution    &solution;
    const std::vector<EnergyLevel> &levels; ///< of all cycles, this one last
  };

  /** What kind of estimator it is. */
  struct EstimatorTraits
  {
    std::string name;          ///< for columns and the log: "spr"
    std::string documentation; ///< one or two sentences for the user
    bool        needs_reference          = false;
    bool        needs_exact_displacement = false;
    /** Whether it solves with the solution's system again (a dual problem). */
    bool needs_system = false;
    /** Whether it counts on the solution to fulfil the discrete equations, so that the
     * solver must not end with an error that the mesh's alone would hide. */
    bool needs_equilibrium = false;
    /** Whether global is an energy norm, and indicators its parts: the root of the
     * sum of their squares where the class does not say otherwise. */
    bool is_energy_norm = true;
  };

  /**
   * Estimates the error of a displacement, per cell and in all. To add one:
   * derive a class, give it a word in scene::ErrorEstimator, and list it in
   * estimator.cc.
   */
  class Estimator
  {
  public:
    virtual ~Estimator() = default;

    virtual EstimatorTraits
    traits() const = 0;

    /** Collective over the comparison's communicator.
     * @throws core::InputError if what it needs is not there. */
    virtual Estimate
    estimate(const EstimateInput &input) const = 0;
  };

  std::unique_ptr<Estimator>
  make_estimator(scene::ErrorEstimator which);
} // namespace tetradapt::estimate

#endif
