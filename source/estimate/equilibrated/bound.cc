// SPDX-License-Identifier: AGPL-3.0-or-later
#include "bound.h"

#include "oscillation.h"
#include "stress.h"

#include "tetradapt/compare/parallel.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/mechanics/springs.h"
#include "tetradapt/mechanics/supports.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** Adds to @p cell_energy what temperatures leave over; returns the sum of
     * the squares of load_oscillation(). */
    double
    add_oscillations(const EquilibratedStress &stress,
                     const compare::Slice     &cells,
                     std::vector<double>      &cell_energy)
    {
      double    sum = 0.;
      CellState state;
      for (unsigned int cell = cells.begin; cell < cells.end; ++cell)
        {
          std::array<double, 4> on_faces{{0., 0., 0., 0.}};
          bool                  any = stress.states.has_variable_loads(cell);
          for (unsigned int f = 0; f < 4; ++f)
            {
              const unsigned int which = stress.faces.boundary[stress.faces.sides[cell][f].face];
              if (which != dealii::numbers::invalid_unsigned_int)
                on_faces[f] = stress.loads[which].oscillation;
              any = any || on_faces[f] > 0.;
            }
          if (!any)
            continue;
          stress.states.compute(cell, state);
          cell_energy[cell] += state.thermal_oscillation;
          const double rest
            = load_oscillation(state, stress.states.largest_compliance(cell), on_faces);
          sum += rest * rest;
        }
      return sum;
    }
    /** The root of int (u - v) . K (u - v) over the springs, @p u of degree 1 and @p v of degree 2
     * on the same mesh. */
    double
    spring_distance(const mesh::NodalField &u, const mesh::NodalField &v, const scene::Scene &scene)
    {
      const mechanics::Springs springs(scene, u.mesh());
      if (springs.empty())
        return 0.;
      const auto nodes  = mechanics::boundary_face_nodes(v.mesh(), &v.edges());
      double     square = 0., N[6];
      for (const mechanics::Springs::Face &face : springs.faces())
        for (const mechanics::Springs::Sample &point : face.points)
          {
            mechanics::face_shape_values(v.degree(), point.b, N);
            Tensor<1, 3> difference;
            for (unsigned int i = 0; i < 6; ++i)
              difference -= N[i] * v.values[nodes[face.face][i]];
            for (unsigned int i = 0; i < 3; ++i)
              difference += point.b[i] * u.values[nodes[face.face][i]];
            square += point.weight * (difference * (point.stiffness * difference));
          }
      return std::sqrt(std::max(square, 0.));
    }
  } // namespace

  EquilibratedBound
  equilibrated_bound(const mesh::NodalField       &u_h,
                     const mesh::NodalField       &galerkin,
                     const scene::Scene           &scene,
                     const mechanics::MaterialMap &materials,
                     MPI_Comm                      communicator,
                     const double                  near)
  {
    const unsigned int       n_cells = u_h.mesh().n_cells();
    const EquilibratedStress stress(u_h, galerkin, scene, materials, communicator, near);
    EquilibratedBound        result;
    result.cell_energy.assign(n_cells, 0.);
    std::vector<double> loads(1, 0.);
    double              supports = 0.;
    core::together(communicator, [&] {
      const compare::Slice own   = compare::own_slice(n_cells, communicator);
      const auto           found = stress.energies(own.begin, own.end);
      for (unsigned int i = 0; i < found.size(); ++i)
        result.cell_energy[own.begin + i] = std::sqrt(found[i]);
      loads[0] = add_oscillations(stress, own, result.cell_energy);
      supports = support_oscillation(u_h, *stress.edges, stress.faces, scene, materials);
    });
    compare::gather_slices(result.cell_energy, n_cells, 1, communicator);
    compare::sum_over_ranks(loads, communicator);
    double sum = 0.;
    for (const double e : result.cell_energy)
      sum += e * e;
    if (&u_h != &galerkin)
      supports = std::hypot(supports, spring_distance(u_h, galerkin, scene));
    result.global      = std::sqrt(loads[0]) + std::sqrt(sum + supports * supports);
    result.oscillation = result.global - std::sqrt(sum);
    return result;
  }
} // namespace tetradapt::estimate
