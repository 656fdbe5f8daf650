// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/comparison.h"

#include "tetradapt/core/exceptions.h"

namespace tetradapt::estimate
{
  Comparison::Comparison(std::shared_ptr<const mesh::NodalField>           displacement,
                         const mechanics::MaterialMap                     &materials,
                         const scene::ExactSolutionParameters             &exact_solution,
                         std::shared_ptr<const compare::ReferenceSampling> sampling,
                         const MPI_Comm                                    communicator,
                         compare::ExcludedRegion                           excluded)
    : u_h(std::move(displacement)), materials(materials), exact_solution(exact_solution),
      sampling(std::move(sampling)), communicator(communicator), excluded(std::move(excluded))
  {
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
        reference_difference = sampling->hexahedra() != nullptr
                                 ? compare::difference_to_hexahedra(*u_h, *sampling)
                                 : compare::difference_to_reference(*u_h, locator(), *sampling);
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
        true_difference
          = compare::difference_to_exact(*u_h, exact_solution, materials, communicator, excluded);
      }
    return *true_difference;
  }



  const compare::NodalRen &
  Comparison::ren()
  {
    if (!has_exact_displacement())
      return ren_to_reference();
    if (!true_ren)
      true_ren = compare::nodal_ren(*u_h, exact_solution, communicator, excluded);
    return *true_ren;
  }



  const compare::NodalRen &
  Comparison::ren_to_reference()
  {
    if (!reference_ren)
      {
        require_reference();
        reference_ren = compare::nodal_ren(*u_h, *sampling);
      }
    return *reference_ren;
  }



  const compare::PointLocator &
  Comparison::locator()
  {
    if (own_locator == nullptr)
      own_locator = std::make_unique<compare::PointLocator>(u_h->shared_mesh());
    return *own_locator;
  }
} // namespace tetradapt::estimate
