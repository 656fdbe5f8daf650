// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_equilibrated_h
#define tetradapt_estimate_equilibrated_equilibrated_h

#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /**
   * Guaranteed upper bound (Prager and Synge 1947): the distance of the stress to
   * one in exact equilibrium; see equilibrated_bound().
   *
   * For degree 1 the equilibrated stress is made from the solution of degree 2 on the same
   * mesh. Linear displacements fix each cell's mean stress, which near incompressibility
   * is far off (locking), and so would be every stress that is balanced by them: at nu = 0.49 the
   * index was 5 and more.
   */
  class Equilibrated : public Estimator
  {
  public:
    EstimatorTraits
    traits() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /**
   * What no estimator sees of the loads: for each cell an energy norm that the part of the
   * body force, the tractions on its faces and the thermal strain can cause which is no
   * quadratic polynomial there, see load_oscillation(). It is added to the indicators that drive
   * refinement, so that peaks and jumps of loads are resolved.
   *
   * @return one a cell; empty if no load varies. Collective.
   */
  std::vector<double>
  load_oscillations(const mesh::NodalField       &u_h,
                    const scene::Scene           &scene,
                    const mechanics::MaterialMap &materials,
                    MPI_Comm                      communicator);
} // namespace tetradapt::estimate

#endif
