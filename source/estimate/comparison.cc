// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/comparison.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/fem/replication.h"

namespace tetradapt::estimate
{
  Comparison::Comparison(std::shared_ptr<const fem::Field>                 displacement,
                         const mechanics::MaterialMap                     &materials,
                         const scene::ExactSolutionParameters             &exact_solution,
                         std::shared_ptr<const compare::ReferenceSampling> sampling,
                         const MPI_Comm                                    communicator,
                         compare::ExcludedRegion                           excluded)
    : distributed(std::move(displacement)), body(distributed->space().shared_mesh()),
      edge_table(distributed->degree() == 2 ? distributed->space().shared_edges() : nullptr),
      materials(materials), exact_solution(exact_solution), sampling(std::move(sampling)),
      communicator(communicator), excluded(std::move(excluded))
  {
  }



  const mesh::NodalField &
  Comparison::displacement()
  {
    if (replicated == nullptr)
      replicated = fem::replicate(*distributed);
    return *replicated;
  }



  void
  Comparison::require_reference() const
  {
    if (!has_reference())
      throw core::InputError(
        "A comparison with a reference solution is needed, but the scene has no reference. Set "
        "Reference/Type, or choose another Adaptivity/Refinement indicator.");
  }



  const compare::Difference &
  Comparison::to_reference()
  {
    if (!reference_difference)
      {
        require_reference();
        reference_difference
          = sampling->hexahedra() != nullptr
              ? compare::difference_to_hexahedra(displacement(), *sampling)
              : compare::difference_to_reference(displacement(), locator(), *sampling);
      }
    return *reference_difference;
  }



  const compare::Difference &
  Comparison::to_exact_solution()
  {
    if (!true_difference)
      {
        if (!has_exact_displacement())
          throw core::InputError(
            "A comparison with the exact solution is needed, but the scene gives none. Set Exact "
            "solution/Displacement, or choose another Adaptivity/Refinement indicator.");
        true_difference = compare::difference_to_exact(
          displacement(), exact_solution, materials, communicator, excluded);
      }
    return *true_difference;
  }



  const compare::NodalRen &
  Comparison::ren()
  {
    if (!has_exact_displacement())
      return ren_to_reference();
    if (!true_ren)
      true_ren = compare::nodal_ren(displacement(), exact_solution, communicator, excluded);
    return *true_ren;
  }



  const compare::NodalRen &
  Comparison::ren_to_reference()
  {
    if (!reference_ren)
      {
        require_reference();
        reference_ren = compare::nodal_ren(displacement(), *sampling);
      }
    return *reference_ren;
  }



  const compare::PointLocator &
  Comparison::locator()
  {
    if (own_locator == nullptr)
      own_locator = std::make_unique<compare::PointLocator>(body);
    return *own_locator;
  }



  void
  Comparison::reduce_to_displacement()
  {
    displacement();
    distributed.reset();
    own_locator.reset();
    reference_difference.reset();
    true_difference.reset();
    reference_ren.reset();
    true_ren.reset();
  }
} // namespace tetradapt::estimate
