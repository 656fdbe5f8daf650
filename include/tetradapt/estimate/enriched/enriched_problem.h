// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_enriched_enriched_problem_h
#define tetradapt_estimate_enriched_enriched_problem_h

#include "tetradapt/estimate/enriched/space.h"
#include "tetradapt/estimate/estimator.h"

namespace tetradapt::estimate
{
  /**
   * A scene's static problem in the space of the next degree: what its residual is for a
   * solution, and the correction that makes it zero. Dual problems differ in their
   * forces only.
   *
   * Corrections are solved for by conjugate gradients, preconditioned additively by what
   * solved the solution (its degree) and by the 3x3 diagonal blocks of the surplus, which
   * in a hierarchical basis is enough for a rate that does not depend on the mesh
   * (Bank and Smith, SIAM J. Numer. Anal. 30, 1993).
   */
  class EnrichedProblem
  {
  public:
    using Values = EnrichedSpace::Values;

    /** Keeps references to the solution of @p input, which must have its system, and to its
     * displacement. @throws core::InputError if it has no system. Collective. */
    explicit EnrichedProblem(const EstimateInput &input);

    const EnrichedSpace &
    space() const
    {
      return enriched_space;
    }

    /** The solution with what the supports prescribe in the surplus: what a correction,
     * zero at the supports, is added to. */
    Values
    supported_solution() const;

    /** F(phi_i) - a(u, phi_i) where nothing is supported, else zero. Collective. */
    Values
    residual(const Values &u) const;

    /** @p forces with zeros where a component is supported. */
    void
    clear_supported(Values &forces) const;

    struct Correction
    {
      Values       values;       ///< e, zero at supports
      double       norm    = 0.; ///< energy norm of e
      double       error   = 0.; ///< estimated energy norm of what is missing in e
      double       missing = 0.; ///< what to add to the square of the norm of e, relative to it
      unsigned int n_iterations = 0;
    };

    /** Solves a(e, phi_i) = forces_i for all functions, until the error of e is
     * estimated to be @p tolerance times its norm; with Solver/Stopping = residual until the
     * residual is so small that what is left does not show in estimates: the preconditioner
     * depends on the number of ranks. Collective.
     * @throws core::NumericalError if it does not converge. */
    Correction
    solve(const Values &forces, double tolerance) const;

  private:
    struct FreeStiffness;
    struct AdditivePreconditioner;
    void
    precondition(const Values &residual, Values &result) const;

    const solve::StaticSystem        &system;
    const mesh::NodalField           &displacement;
    scene::SolverParameters::Stopping stopping;
    mechanics::Springs                springs;
    EnrichedSpace                     enriched_space;
    mechanics::PrescribedDisplacement prescribed;     ///< of the surplus
    Values                            loads;          ///< F(phi_i)
    mutable std::vector<double>       block_inverses; ///< made when they are first asked for
    mutable std::vector<Tensor<1, 3>> nodal_residual; ///< work space
  };
} // namespace tetradapt::estimate

#endif
