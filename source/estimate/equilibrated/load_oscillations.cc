// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/equilibrated/equilibrated.h"

#include "loads.h"
#include "oscillation.h"

#include "tetradapt/compare/parallel.h"
#include "tetradapt/core/expression.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/core/surface_expression.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** Whether a load may be other than what the equilibrated stress has room for; a total force
     * that is even and a rotation are linear. */
    bool
    varies(const scene::LoadParameters &load)
    {
      if (load.type == scene::LoadType::total_force)
        return load.total.distribution == scene::Distribution::bearing;
      return load.type != scene::LoadType::nodal_force && load.type != scene::LoadType::point_force
             && !core::SurfaceExpression(load.value, "Loads/" + load.name + "/Value").is_constant();
    }

    /** The same of a support; tractions of even springs are of the degree of the solution. */
    bool
    has_varying_springs(const scene::SupportParameters &support)
    {
      const std::string path = "Supports/" + support.name;
      return support.type == scene::SupportType::spring
             && !(core::Expression(support.spring.stiffness, path + "/Stiffness").is_constant()
                  && core::VectorExpression(support.displacement, path + "/Displacement")
                       .is_constant());
    }
  } // namespace

  std::vector<double>
  load_oscillations(const mesh::NodalField       &u_h,
                    const scene::Scene           &scene,
                    const mechanics::MaterialMap &materials,
                    MPI_Comm                      communicator)
  {
    std::vector<double> result;
    if (std::none_of(scene.loads.begin(), scene.loads.end(), varies)
        && std::none_of(scene.supports.begin(), scene.supports.end(), has_varying_springs))
      return result;
    const mesh::TetMesh &mesh = u_h.mesh();
    result.assign(mesh.n_cells(), 0.);
    core::together(communicator, [&] {
      const CellStates            states(u_h, materials);
      const CellFaces             faces(mesh);
      const std::vector<FaceLoad> loads = face_loads(scene, u_h);
      const compare::Slice        own   = compare::own_slice(mesh.n_cells(), communicator);
      CellState                   state;
      for (unsigned int cell = own.begin; cell < own.end; ++cell)
        {
          std::array<double, 4> on_faces{{0., 0., 0., 0.}};
          for (unsigned int f = 0; f < 4; ++f)
            {
              const unsigned int which = faces.boundary[faces.sides[cell][f].face];
              if (which != dealii::numbers::invalid_unsigned_int)
                on_faces[f] = loads[which].oscillation;
            }
          if (!states.has_variable_loads(cell)
              && *std::max_element(on_faces.begin(), on_faces.end()) == 0.)
            continue;
          states.compute_loads(cell, state);
          const double forces = load_oscillation(state, states.largest_compliance(cell), on_faces);
          result[cell]        = std::hypot(forces, state.thermal_oscillation);
        }
    });
    compare::gather_slices(result, mesh.n_cells(), 1, communicator);
    return result;
  }
} // namespace tetradapt::estimate
