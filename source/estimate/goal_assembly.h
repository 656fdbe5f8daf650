// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_goal_assembly_h
#define tetradapt_estimate_goal_assembly_h

#include "tetradapt/estimate/goal_functional.h"

namespace tetradapt::estimate
{
  /** Collects what single points give to a functional, on one rank. */
  class GoalAssembly
  {
  public:
    /** Keeps references. @param surplus may be null. */
    GoalAssembly(const mesh::NodalField       &field,
                 const HierarchicalSurplus    *surplus,
                 const mechanics::MaterialMap &materials);

    /** Adds force . u at a point of @p cell. */
    void
    add_force(unsigned int cell, const mesh::Barycentric &b, const Tensor<1, 3> &force);

    /** Adds S : stress(u) at a point of @p cell. */
    void
    add_stress(unsigned int                         cell,
               const mesh::Barycentric             &b,
               const dealii::SymmetricTensor<2, 3> &S);

    /** The sum over the ranks, divided by @p measure. Collective; once only. */
    GoalFunctional
    finish(double measure, MPI_Comm communicator);

  private:
    void
    add(std::size_t function, const Tensor<1, 3> &force)
    {
      for (unsigned int c = 0; c < 3; ++c)
        forces[3 * function + c] += force[c];
    }

    const mesh::NodalField       &field;
    const HierarchicalSurplus    *surplus;
    const mechanics::MaterialMap &materials;
    std::vector<double>           forces;
    double                        offset = 0.;
  };
} // namespace tetradapt::estimate

#endif
